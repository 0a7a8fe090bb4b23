// The names in a tree of nodes: which node an id means.
#pragma once

#include "io/node.h"

#include <map>
#include <string>

namespace mlt {

/// Nodes, includes and references may be nested this deep; deeper is a mistake or an attack.
constexpr int max_nesting = 100;

using NodeIndex = std::map<std::string, const Node*>;

/// All nodes with an id, at any depth. Throws SceneError for an id given twice and for runaway
/// nesting. The tree must outlive the index and stay where it is.
NodeIndex index_nodes(const Node& root);

/// The node that `id` means; throws SceneError with a suggestion.
const Node& find_node(const NodeIndex& index, const std::string& id, const Location& where);

}  // namespace mlt
