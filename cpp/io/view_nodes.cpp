#include "io/view_nodes.h"

#include "io/node_properties.h"

#include <fmt/format.h>

#include <algorithm>

namespace mlt {
namespace {

/// The property of a scene's node that is the index of the sensor.
constexpr char sensor_property[] = "sensor";

std::optional<int64_t> asked_sensor(const Node& scene) {
  for (const Node::Property& property : scene.properties)
    if (property.name == sensor_property)
      if (const auto* index = std::get_if<int64_t>(&property.value)) return *index;
  return std::nullopt;
}

/// The sensors of the scene and those on its shapes, in their order.
std::vector<const Node*> all_sensors(const Node& scene) {
  std::vector<const Node*> sensors;
  for (const Node& child : scene.children) {
    if (child.family == "sensor") sensors.push_back(&child);
    if (child.family != "shape") continue;
    for (const Node& part : child.children)
      if (part.family == "sensor") sensors.push_back(&part);
  }
  return sensors;
}

/// The property `aovs` of Mitsuba's integrator of that name.
std::string asked_aovs(const Node& integrator) {
  for (const Node::Property& property : integrator.properties)
    if (property.name == "aovs")
      if (const auto* list = std::get_if<std::string>(&property.value)) return *list;
  throw SceneError(at(integrator.where,
                      "integrator 'aov' needs a string 'aovs', such as "
                      "'albedo:albedo, nn:sh_normal'"));
}

}  // namespace

const Node& unwrapped(const Node& integrator, std::string& aovs,
                      std::vector<std::string>& warnings) {
  if (integrator.type != "moment" && integrator.type != "aov") return integrator;
  const bool alone = std::none_of(integrator.children.begin(), integrator.children.end(),
                                  [](const Node& child) { return child.family == "integrator"; });
  if (integrator.type == "aov" && alone && !find_property(integrator, "aovs")) return integrator;
  if (integrator.type == "aov") aovs = asked_aovs(integrator);
  for (const Node& child : integrator.children)
    if (child.family == "integrator") {
      if (integrator.type == "moment")
        warnings.push_back(at(integrator.where,
                              "integrator 'moment' is not supported; the '{}' inside it is used",
                              child.type));
      return unwrapped(child, aovs, warnings);
    }
  if (integrator.type == "aov") return integrator;
  throw SceneError(
      at(integrator.where, "integrator '{}' has no integrator inside", integrator.type));
}

Node asking_for(Node scene, int64_t sensor) {
  set_property(scene, sensor_property, sensor);
  return scene;
}

void change_films(Node& node, const std::function<void(Node&)>& change) {
  const auto is_film = [](const Node& n) { return n.family == "film" || n.family == "ref"; };
  auto& children = node.children;
  if (node.family == "film") change(node);
  if (node.family == "sensor" && std::none_of(children.begin(), children.end(), is_film))
    children.push_back({"film", "hdrfilm", "", "", node.where, {}, {}});
  for (Node& child : children) change_films(child, change);
}

void make_spectral(Node& tree, const std::string& band) {
  change_films(tree, [&](Node& film) {
    set_property(film, "spectral", true);
    if (!band.empty()) set_property(film, "band", band);
  });
}

const Node& chosen_sensor(const Node& scene, std::vector<std::string>& warnings) {
  const std::vector<const Node*> sensors = all_sensors(scene);
  if (sensors.empty())
    throw SceneError(at(scene.where, "the scene has no sensor; add <sensor type=\"perspective\">"));
  const auto asked = asked_sensor(scene);
  const auto last = static_cast<int64_t>(sensors.size()) - 1;
  if (asked && (*asked < 0 || *asked > last))
    throw UsageError(
        last == 0 ? fmt::format("there is no sensor {}: the scene has one, number 0", *asked)
                  : fmt::format("there is no sensor {}: the scene's are 0 to {}", *asked, last));
  if (!asked && last > 0)
    warnings.push_back(at(sensors[1]->where,
                          "this scene has {} sensors; the first one is used, since none was named",
                          sensors.size()));
  return *sensors[static_cast<size_t>(asked.value_or(0))];
}

size_t sensor_count(const Node& scene) { return all_sensors(scene).size(); }

void find_integrator(const Node& scene, LoadedScene& loaded) {
  const Node* integrator = nullptr;
  for (const Node& child : scene.children) {
    if (child.family != "integrator") continue;
    if (integrator)
      throw SceneError(at(child.where, "the scene has a second integrator; keep one"));
    integrator = &child;
  }
  if (integrator) loaded.integrator = unwrapped(*integrator, loaded.aovs, loaded.warnings);
}

}  // namespace mlt
