#include "job/make_integrator.h"

#include "io/values.h"
#include "io/view_nodes.h"

#include <algorithm>

namespace mlt {
namespace {

const Node::Property* find(const Node& node, const std::string& name) {
  for (const Node::Property& property : node.properties)
    if (snake_case(property.name) == name) return &property;
  return nullptr;
}

void assign(Node& node, const std::string& name, const std::string& text, const Schema& schema) {
  const Parameter* parameter = schema.find(snake_case(name));
  if (!parameter)
    throw UsageError("unknown parameter '" + name + "' for integrator '" + schema.name + "'" +
                     suggestion(snake_case(name), schema.parameter_names()));
  auto& given = node.properties;
  given.erase(std::remove_if(given.begin(), given.end(),
                             [&](const Node::Property& property) {
                               return snake_case(property.name) == parameter->name;
                             }),
              given.end());
  given.push_back({parameter->name, parse_value(text, *parameter), {}});
}

/// Copies the parameters that the expected image depends on, rather than on the algorithm.
void inherit(Node& node, const Node& own, const Schema& schema) {
  for (const char* name : {"max_depth", "hide_emitters", "strict_normals"})
    if (const Node::Property* property = find(own, name); property && schema.find(name))
      node.properties.push_back(*property);
}

/// The names of the integrators that have a parameter.
std::string those_with(const Registry& registry, const std::string& parameter) {
  std::string names;
  for (const std::string& name : registry.names("integrator"))
    if (registry.find("integrator", name, {}).schema.find(parameter))
      names += (names.empty() ? "" : ", ") + name;
  return names;
}

Json describe(const Node& node, const Registry& registry) {
  const Schema& schema = registry.find(node.family, node.type, node.where).schema;
  Json json;
  json.add("type", schema.name);
  for (const Parameter& parameter : schema.parameters) {
    const Node::Property* given = find(node, parameter.name);
    json.add(parameter.name, given ? given->value : parameter.default_value);
  }
  for (const Node& child : node.children)
    json.add(child.name.empty() ? child.family : child.name, describe(child, registry));
  return json;
}

}  // namespace

Node choose_integrator(const LoadedScene& loaded, const std::string& name,
                       const Assignments& assignments, const Registry& registry) {
  Node node;
  node.family = "integrator";
  node.type = name.empty() ? "mlt" : name;
  const std::optional<Node>& own = loaded.integrator;
  if (own && (name.empty() || name == own->type)) node = *own;
  const Schema& schema = registry.find("integrator", node.type, node.where).schema;
  if (own && node.type != own->type) inherit(node, *own, schema);
  for (const auto& [parameter, text] : assignments) assign(node, parameter, text, schema);
  return node;
}

MadeIntegrator make_integrator(const Node& given, const Registry& registry) {
  MadeIntegrator made;
  const Node& node = unwrapped(given, made.aovs, made.warnings);
  const ObjectPtr object = build_object(node, registry, made.warnings);
  made.integrator = std::dynamic_pointer_cast<const Integrator>(object);
  if (!made.integrator)
    throw SceneError(at(node.where, "'" + node.type + "' is not an integrator"));
  made.node = node;
  made.settings = describe(node, registry);
  if (const Node::Property* hides = find(node, "hide_emitters"))
    made.hide_emitters = std::get<bool>(hides->value);
  return made;
}

MadeIntegrator with_light_layers(const MadeIntegrator& made, const LightLayerSettings& layers,
                                 const Registry& registry) {
  if (!layers.any()) return made;
  if (made.extra_mutations)
    throw UsageError(
        "give light_groups and light_layers to the integrator, beside its mutations in Python");
  Node node = made.node;
  const Schema& schema = registry.find(node.family, node.type, node.where).schema;
  if (!schema.find("light_groups"))
    throw UsageError("'" + schema.name + "' keeps no layers of light; those that do are " +
                     those_with(registry, "light_groups"));
  if (layers.groups) assign(node, "light_groups", "true", schema);
  if (layers.exposures) assign(node, "exposure_layers", "true", schema);
  if (!layers.classes.empty()) assign(node, "light_layers", layers.text(), schema);
  MadeIntegrator layered = make_integrator(node, registry);
  layered.aovs = made.aovs;
  layered.warnings = made.warnings;
  return layered;
}

std::string integrator_problem(const LoadedScene& loaded, const Registry& registry) {
  try {
    make_integrator(choose_integrator(loaded, "", {}, registry), registry);
    return "";
  } catch (const SceneError& error) {
    return error.what();
  }
}

const Node& node_of(const MadeIntegrator& made) {
  if (made.extra_mutations)
    throw UsageError(
        "a render with mutations that are written in Python stays in its process: it has no "
        "checkpoint and cannot be sent to others");
  return made.node;
}

MadeIntegrator with_mutations(MadeIntegrator made, const std::vector<ExtraMutation>& extra) {
  made.integrator = made.integrator->with_mutations(extra);
  made.extra_mutations = true;
  Json weights;
  for (const ExtraMutation& mutation : extra) weights.add(mutation.name, mutation.weight);
  made.settings.add("extra_mutations", weights);
  return made;
}

}  // namespace mlt
