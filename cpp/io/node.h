// The one tree that every scene description becomes, whether it was XML or a dict.
#pragma once

#include "base/schema.h"

#include <string>
#include <vector>

namespace mlt {

struct Node {
  struct Property {
    std::string name;
    Value value;  ///< Never an object: nested objects are children.
    Location where;
  };

  std::string
      family;  ///< "scene", "shape", "bsdf", "emitter", "sensor", "film", "rfilter", ...; "ref".
  std::string type;  ///< Plug-in name; for a "ref" the id that it refers to.
  std::string id;    ///< The name by which references find it, or "".
  std::string name;  ///< The parameter of the parent that it is given for, or "".
  Location where;
  std::vector<Property> properties;
  std::vector<Node> children;
};

}  // namespace mlt
