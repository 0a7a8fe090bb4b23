// The tree of a scene description, whether it was XML or a dict, and the index of its nodes by
// id.
#pragma once

#include "base/schema.h"

#include <map>
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
  bool modern = true;  ///< Whether the format of its file is that of Mitsuba 2 or later.
};

/// Nodes, includes and references may be nested this deep; deeper is a mistake or an attack.
constexpr int max_nesting = 100;

/// The most parts of a BSDF or a texture; one that is referred to twice counts twice, since it is
/// evaluated twice.
constexpr size_t max_parts = 1000;

using NodeIndex = std::map<std::string, const Node*>;

/// Indexes all nodes with an id, at any depth. Throws SceneError for an id given twice and for
/// runaway nesting. The tree must outlive the index and not be moved.
NodeIndex index_nodes(const Node& root);

/// The node with this id; throws SceneError with a suggestion.
const Node& find_node(const NodeIndex& index, const std::string& id, const Location& where);

}  // namespace mlt
