#include "io/aliases.h"

#include "base/text.h"

namespace mlt {
namespace {

void rename_references(Node& node, const std::map<std::string, std::string>& target_of) {
  if (node.family == "ref") {
    const auto found = target_of.find(node.type);
    if (found != target_of.end()) node.type = found->second;
  }
  for (Node& child : node.children) rename_references(child, target_of);
}

}  // namespace

void resolve_aliases(Node& root, const Aliases& aliases) {
  const NodeIndex index = index_nodes(root);
  std::map<std::string, std::string> target_of;
  for (const auto& [name, alias] : aliases) {
    if (index.count(name))
      throw SceneError(at(alias.where, "the alias {} is already the id of an object", quote(name)));
    std::string target = alias.id;
    for (int hops = 1; aliases.count(target); ++hops) {
      if (hops >= max_nesting)
        throw SceneError(at(alias.where, "the alias {} means itself, or more than {} others",
                            quote(name), max_nesting));
      target = aliases.at(target).id;
    }
    find_node(index, target, alias.where);
    target_of[name] = target;
  }
  if (!target_of.empty()) rename_references(root, target_of);
}

}  // namespace mlt
