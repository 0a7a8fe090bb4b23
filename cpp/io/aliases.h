// Second names of objects: <alias id="a" as="b"/>.
#pragma once

#include "io/node.h"

#include <map>
#include <string>

namespace mlt {

struct Alias {
  std::string id;
  Location where;
};

using Aliases = std::map<std::string, Alias>;  ///< By the new name.

/// References by second names become references by ids. Throws SceneError for a name that is an id
/// already, that means itself, or that means nothing.
void resolve_aliases(Node& root, const Aliases& aliases);

}  // namespace mlt
