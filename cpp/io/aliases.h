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

using Aliases = std::map<std::string, Alias>;  ///< Aliases by their new names.

/// Replaces references by second names by references by ids. Throws SceneError for a name that is
/// an id already, that refers to itself, or to nothing.
void resolve_aliases(Node& root, const Aliases& aliases);

}  // namespace mlt
