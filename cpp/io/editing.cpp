#include "io/editing.h"

#include "base/text.h"
#include "io/leniency.h"

#include <algorithm>
#include <set>

namespace mlt {
namespace {

class Naming {
 public:
  explicit Naming(const Registry& registry) : registry_(registry) {}

  void visit(Node& parent, const std::string& prefix) {
    for (Node& child : parent.children) {
      if (child.family == "ref") continue;
      const std::string name = unique(name_of(child, prefix));
      if (registry_.has(child.family, child.type))
        found.push_back(
            {name, &child, &registry_.find(child.family, child.type, child.where).schema});
      visit(child, name);
    }
  }

  std::vector<NamedNode> found;

 private:
  static std::string name_of(const Node& node, const std::string& prefix) {
    if (!node.id.empty()) return node.id;
    if (prefix.empty()) return node.family;
    const bool part = node.name.empty() || node.family == "bsdf" || node.family == "emitter" ||
                      node.family == "film" || node.family == "sampler";
    return prefix + "." + (part ? node.family : snake_case(node.name));
  }

  std::string unique(const std::string& name) {
    std::string tried = name;
    for (int i = 1; !used_.insert(tried).second; ++i) tried = fmt::format("{}_{}", name, i);
    return tried;
  }

  const Registry& registry_;
  std::set<std::string> used_;
};

/// The parameters that are removed when this one is given: an image is a file or an array.
std::vector<std::string> excluded_by(const std::string& parameter) {
  if (parameter == "data") return {"filename", "data_shape", "data_type"};
  if (parameter == "filename") return {"data", "data_shape", "data_type"};
  return {};
}

bool means(const NamedNode& plugin, const std::string& name, const std::string& parameter) {
  return !name.empty() && snake_case(current_name(*plugin.node, name, *plugin.schema)) == parameter;
}

/// Replaces the value of the parameter by `other`; removes it without one.
template <class Given>
void replace(const NamedNode& plugin, const std::string& parameter, std::vector<Given>& all,
             const Given* other = nullptr) {
  const auto meant = [&](const Given& given) { return means(plugin, given.name, parameter); };
  const auto first = std::find_if(all.begin(), all.end(), meant);
  if (other && first != all.end())
    *first = *other;
  else if (other)
    all.push_back(*other);
  else if (first != all.end())
    all.erase(first);
}

/// The parameter that has exactly this name; without a plug-in if there is none.
NamedParameter parameter_named(const std::vector<NamedNode>& nodes, const std::string& name) {
  const size_t dot = name.rfind('.');
  if (dot == std::string::npos) return {};
  for (const NamedNode& plugin : nodes)
    if (plugin.name == name.substr(0, dot))
      for (const Parameter* parameter : plugin.parameters())
        if (parameter->name == snake_case(name.substr(dot + 1))) return {&plugin, parameter};
  return {};
}

}  // namespace

std::vector<const Parameter*> NamedNode::parameters() const {
  std::vector<const Parameter*> all;
  for (const Parameter& parameter : schema->parameters)
    if (parameter.type != ParamType::object) all.push_back(&parameter);
  return all;
}

const Node::Property* NamedNode::property(const std::string& parameter) const {
  for (const Node::Property& property : node->properties)
    if (means(*this, property.name, parameter)) return &property;
  return nullptr;
}

const Node* NamedNode::child(const std::string& parameter) const {
  for (const Node& child : node->children)
    if (means(*this, child.name, parameter)) return &child;
  return nullptr;
}

std::vector<NamedNode> name_nodes(Node& tree, const Registry& registry) {
  Naming naming(registry);
  naming.visit(tree, "");
  return std::move(naming.found);
}

NamedParameter find_parameter(const std::vector<NamedNode>& nodes, const std::string& full_name) {
  if (const NamedParameter found = parameter_named(nodes, full_name); found.plugin) return found;
  // Mitsuba 3 says "red.reflectance.value".
  constexpr std::string_view value = ".value";
  const bool long_form =
      full_name.size() > value.size() &&
      full_name.compare(full_name.size() - value.size(), value.size(), value) == 0;
  const std::string name = full_name.substr(0, full_name.size() - (long_form ? value.size() : 0));
  if (const NamedParameter found = parameter_named(nodes, name); found.plugin) return found;
  std::vector<std::string> names;
  for (const NamedNode& plugin : nodes)
    for (const Parameter* parameter : plugin.parameters())
      names.push_back(plugin.name + "." + parameter->name);
  const std::string near = closest(name.substr(0, 200), names);
  throw UsageError(fmt::format("the scene has no parameter {}{}", quote(name),
                               near.empty() ? "; scene.parameters() names them all"
                                            : "; did you mean " + quote(near) + "?"));
}

void apply(std::vector<Change> changes) {
  // nested plug-ins come first: a change moves the children of its plug-in
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.plugin > b.plugin; });
  for (const auto& [plugin, given] : changes) {
    auto& properties = plugin->node->properties;
    auto& children = plugin->node->children;
    for (const Node::Property& property : given.properties) {
      replace(*plugin, property.name, children);
      replace(*plugin, property.name, properties, &property);
      for (const std::string& other : excluded_by(property.name))
        replace(*plugin, other, properties);
    }
    for (const Node& child : given.children) {
      replace(*plugin, child.name, properties);
      replace(*plugin, child.name, children, &child);
    }
  }
}

}  // namespace mlt
