#include "io/surface_names.h"

#include "io/editing.h"
#include "scene/accel/instance.h"

#include <map>
#include <set>

namespace mlt {
namespace {

/// Follows the tree in the order in which the scene was made of it.
class SurfaceNaming {
 public:
  SurfaceNaming(Node& tree, const Registry& registry) : tree_(tree), index_(index_nodes(tree)) {
    for (NamedNode& node : name_nodes(tree, registry)) names_[node.node] = std::move(node.name);
  }

  SurfaceNames names_of(const Scene& scene) const {
    SurfaceNames names;
    std::vector<const Node*> grouped;
    std::set<const ShapeGroup*> seen;
    auto shape = scene.shapes().begin();
    for (const Node& node : tree_.children) {
      if (node.family != "shape" || node.type == "shapegroup") continue;
      const Instance* instance = (*shape++)->as_instance();
      names.objects.push_back(names_.at(&node));
      names.materials.push_back(instance ? "" : material_of(node));
      if (!instance || !seen.insert(&instance->group()).second) continue;
      const std::vector<const Node*> members = members_of(node);
      grouped.insert(grouped.end(), members.begin(), members.end());
    }
    for (const Node* member : grouped) {
      names.objects.emplace_back();
      names.materials.push_back(material_of(*member));
    }
    return names;
  }

 private:
  const Node& resolve(const Node& child) const {
    return child.family == "ref" ? find_node(index_, child.type, child.where) : child;
  }
  std::string material_of(const Node& shape) const {
    for (const Node& child : shape.children)
      if (const Node& node = resolve(child); node.family == "bsdf") return names_.at(&node);
    return default_material;
  }
  /// The shapes that an instance shows: those of its group, or itself if it is a shape that moves.
  std::vector<const Node*> members_of(const Node& instance) const {
    if (instance.type != "instance") return {&instance};
    std::vector<const Node*> members;
    for (const Node& child : instance.children)
      if (const Node& group = resolve(child); group.type == "shapegroup")
        for (const Node& member : group.children)
          if (const Node& shape = resolve(member); shape.family == "shape")
            members.push_back(&shape);
    return members;
  }

  const Node& tree_;
  NodeIndex index_;
  std::map<const Node*, std::string> names_;
};

}  // namespace

SurfaceNames surface_names(const LoadedScene& loaded, const Registry& registry) {
  Node tree = loaded.tree;
  return SurfaceNaming(tree, registry).names_of(*loaded.scene);
}

}  // namespace mlt
