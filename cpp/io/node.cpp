#include "io/node.h"

#include "base/text.h"

namespace mlt {
namespace {

void add(NodeIndex& index, const Node& node, int depth) {
  if (depth > max_nesting)
    throw SceneError(at(node.where, "elements are nested more than {} deep", max_nesting));
  if (!node.id.empty() && node.family != "ref") {
    const auto [first, is_new] = index.emplace(node.id, &node);
    if (!is_new) {
      const std::string place = describe(first->second->where);
      throw SceneError(at(node.where, "the id {} is given twice{}", quote(node.id),
                          place.empty() ? "" : ", first at " + place));
    }
  }
  for (const Node& child : node.children) add(index, child, depth + 1);
}

}  // namespace

NodeIndex index_nodes(const Node& root) {
  NodeIndex index;
  add(index, root, 1);
  return index;
}

const Node& find_node(const NodeIndex& index, const std::string& id, const Location& where) {
  const auto found = index.find(id);
  if (found != index.end()) return *found->second;
  std::vector<std::string> ids;
  for (const auto& [known, node] : index) ids.push_back(known);
  const std::string near = closest(id.substr(0, 80), ids);
  throw SceneError(at(where, "nothing has the id {}{}", quote(id),
                      near.empty() ? "" : "; did you mean " + quote(near) + "?"));
}

}  // namespace mlt
