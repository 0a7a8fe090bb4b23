// pymlt.scenes.arrays converts arrays to bytes, and back.
#include "scene_editing.h"

#include "scene_dict.h"
#include "text.h"

#include "io/editing.h"
#include "io/view_nodes.h"
#include "job/plugins.h"

namespace mlt::python {
namespace {

py::object arrays() { return py::module_::import("pymlt.scenes.arrays"); }

/// The dict that represents a plug-in where a value is expected.
py::dict stand_in(const Node& node) {
  py::dict dict;
  dict["type"] = node.family == "ref" ? "ref" : node.type;
  if (node.family == "ref") dict["id"] = to_str(node.type);
  return dict;
}

/// The current values of a plug-in's parameters; None for those without a value and without a
/// default.
py::dict values_of(const NamedNode& plugin) {
  py::dict values;
  for (const Parameter* parameter : plugin.parameters()) {
    const py::str name(parameter->name);
    if (const Node::Property* property = plugin.property(parameter->name))
      values[name] = to_python(property->value);
    else if (const Node* child = plugin.child(parameter->name))
      values[name] = stand_in(*child);
    else
      values[name] = to_python(parameter->default_value);
  }
  return arrays().attr("with_arrays")(values);
}

/// A node with the parameter as in a scene's description. Errors begin with its full name.
Node given(const NamedParameter& named, const std::string& name, const py::handle& value) {
  py::dict dict;
  dict["type"] = named.plugin->node->type;
  dict[py::str(named.parameter->name)] = value;
  dict = arrays().attr("with_bytes")(dict, to_str(name));
  Node node = to_node(dict, named.plugin->node->family, name, plugins());
  for (Node::Property& property : node.properties) property.where = {name, 0};
  for (Node& child : node.children) child.where = {name, 0};
  return node;
}

/// The requested size of the film, which is edited like that of the scene.
std::optional<Vec2i> edited_size(std::optional<Vec2i> size, const NamedParameter& named,
                                 const py::handle& value) {
  if (!size || named.plugin->node->family != "film" || !py::isinstance<py::int_>(value))
    return size;
  if (named.parameter->name == "width") size->x = value.cast<int>();
  if (named.parameter->name == "height") size->y = value.cast<int>();
  return size;
}

/// The parameters whose names begin so, with the rest of their names.
py::dict parameters_below(const LoadedScene& loaded, const std::string& beginning) {
  Node tree = loaded.tree;
  py::dict all;
  for (const NamedNode& plugin : name_nodes(tree, plugins())) {
    const std::string name = plugin.name + ".";
    if (name.compare(0, beginning.size(), beginning) != 0) continue;
    for (const auto& [parameter, value] : values_of(plugin))
      all[to_str(name.substr(beginning.size()) + std::string(py::str(parameter)))] = value;
  }
  return all;
}

}  // namespace

py::dict scene_parameters(const LoadedScene& loaded) { return parameters_below(loaded, ""); }

py::dict parameters_of(const LoadedScene& loaded, const std::string& part) {
  return parameters_below(loaded, part + ".");
}

LoadedScene updated_scene(const LoadedScene& loaded, const py::dict& values) {
  Node tree = loaded.tree;
  const std::vector<NamedNode> nodes = name_nodes(tree, plugins());
  std::vector<Change> changes;
  std::optional<Vec2i> size = loaded.size;
  for (const auto& [key, value] : values) {
    if (!py::isinstance<py::str>(key)) throw UsageError("a parameter's name should be a string");
    const std::string name = bytes_of(key);
    const NamedParameter named = find_parameter(nodes, name);
    changes.push_back({named.plugin, given(named, name, value)});
    size = edited_size(size, named, value);
  }
  const ReleasedGil release;
  apply(std::move(changes));
  if (size == loaded.size) return build_again(loaded, tree, plugins());
  LoadedScene resized = loaded;
  resized.size = size;
  return build_again(resized, tree, plugins());
}

LoadedScene seen_by(const LoadedScene& loaded, const py::dict& sensor) {
  Node tree = loaded.tree;
  const py::dict given = arrays().attr("with_bytes")(sensor);
  tree.children.push_back(to_node(given, "sensor", "sensor", plugins()));
  const auto last = static_cast<int64_t>(sensor_count(tree)) - 1;
  const ReleasedGil release;
  return build_again(loaded, asking_for(std::move(tree), last), plugins());
}

}  // namespace mlt::python
