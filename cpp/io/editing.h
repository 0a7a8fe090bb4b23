// The parameters of a scene that can be changed, by name. A plug-in is named by its id; one without
// by its parent's name and its role there ("box.bsdf"), at the top of the scene by its
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

  /// The parameters that can be changed: values and textures.
  std::vector<const Parameter*> parameters() const;
  /// The property that is given for a parameter, or nullptr.
  const Node::Property* property(const std::string& parameter) const;
  const Node* child(const std::string& parameter) const;
};

/// The plug-ins of a tree, in the order of the scene, without those that are not known here.
std::vector<NamedNode> name_nodes(Node& tree, const Registry& registry);

/// A parameter of a named plug-in.
struct NamedParameter {
  const NamedNode* plugin;
  const Parameter* parameter;
};

/// Finds a parameter such as "camera.to_world". Throws UsageError with a suggestion.
NamedParameter find_parameter(const std::vector<NamedNode>& nodes, const std::string& name);

/// New values and nested plug-ins for some of a plug-in's parameters.
struct Change {
  const NamedNode* plugin;
  Node given;
};

/// Replaces the given values by new ones. This invalidates the named nodes.
void apply(std::vector<Change> changes);

}  // namespace mlt
