// What of a scene's description can be changed, by name. A plug-in is called by its id; one without
// by its parent's name and what it is to the parent ("box.bsdf"), at the top of the scene by its
// family ("sensor"). Of several with the same name the second one is "shape_1", as in Mitsuba 3.
#pragma once

#include "base/registry.h"
#include "io/node.h"

#include <string>
#include <vector>

namespace mlt {

/// A plug-in of a tree, which must outlive it.
struct NamedNode {
  std::string name;
  Node* node;
  const Schema* schema;

  /// Those that can be changed: values and textures.
  std::vector<const Parameter*> parameters() const;
  /// What is given for a parameter, or nullptr.
  const Node::Property* property(const std::string& parameter) const;
  const Node* child(const std::string& parameter) const;
};

/// In the order of the scene, without those whose plug-in is not known here.
std::vector<NamedNode> name_nodes(Node& tree, const Registry& registry);

/// A parameter of one of them.
struct NamedParameter {
  const NamedNode* plugin;
  const Parameter* parameter;
};

/// What "camera.to_world" means. Throws UsageError with a suggestion.
NamedParameter find_parameter(const std::vector<NamedNode>& nodes, const std::string& name);

/// Other values and nested plug-ins for some of a plug-in's parameters.
struct Change {
  const NamedNode* plugin;
  Node given;
};

/// Puts them in the place of what has been given. The named nodes are of no use any more.
void apply(std::vector<Change> changes);

}  // namespace mlt
