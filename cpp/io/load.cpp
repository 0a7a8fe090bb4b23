#include "io/load.h"

#include "base/atomic_file.h"
#include "io/builder.h"
#include "io/families.h"
#include "io/leniency.h"
#include "io/missing.h"
#include "io/node_bytes.h"
#include "scene/coincident_lights.h"
#include "scene/crossing_boundaries.h"
#include "scene/emitter/daylight.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

namespace mlt {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void check_size(const Vec2i& size) {
  constexpr auto max_side = FilmSettings::max_side;
  if (std::min(size.x, size.y) < 1 || std::max(size.x, size.y) > max_side ||
      int64_t{size.x} * size.y > FilmSettings::max_pixels)
    throw UsageError(fmt::format(
        "the image size is {} x {}, but each side should lie between 1 and {}, and 2^28 pixels are "
        "the most",
        size.x, size.y, max_side));
}

/// The property of a scene's node that is the index of the sensor.
constexpr char sensor_property[] = "sensor";

std::optional<int64_t> asked_sensor(const Node& scene) {
  for (const Node::Property& property : scene.properties)
    if (property.name == sensor_property)
      if (const auto* index = std::get_if<int64_t>(&property.value)) return *index;
  return std::nullopt;
}

void set_property(Node& node, const std::string& name, const Value& value) {
  auto& all = node.properties;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const auto& property) { return property.name == name; }),
            all.end());
  all.push_back({name, value, node.where});
}

Node asking_for(Node scene, int64_t sensor) {
  set_property(scene, sensor_property, sensor);
  return scene;
}

/// Calls change(film) for all films, and adds a film to sensors that have none.
template <class Change>
void change_films(Node& node, const Change& change) {
  const auto is_film = [](const Node& n) { return n.family == "film" || n.family == "ref"; };
  auto& children = node.children;
  if (node.family == "film") change(node);
  if (node.family == "sensor" && std::none_of(children.begin(), children.end(), is_film))
    children.push_back({"film", "hdrfilm", "", "", node.where, {}, {}});
  for (Node& child : children) change_films(child, change);
}

/// Makes films spectral; those of a band if it is not empty.
void make_spectral(Node& tree, const std::string& band) {
  change_films(tree, [&](Node& film) {
    set_property(film, "spectral", true);
    if (!band.empty()) set_property(film, "band", band);
  });
}

const Node& chosen_sensor(const Node& scene, std::vector<std::string>& warnings) {
  std::vector<const Node*> sensors;
  for (const Node& child : scene.children)
    if (child.family == "sensor") sensors.push_back(&child);
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

/// The property `aovs` of Mitsuba's integrator of that name.
std::string asked_aovs(const Node& integrator) {
  for (const Node::Property& property : integrator.properties)
    if (property.name == "aovs")
      if (const auto* list = std::get_if<std::string>(&property.value)) return *list;
  throw SceneError(at(integrator.where,
                      "integrator 'aov' needs a string 'aovs', such as "
                      "'albedo:albedo, nn:sh_normal'"));
}

/// Mitsuba's integrators that only add channels or statistics to the one nested in them.
const Node& unwrapped(const Node& integrator, LoadedScene& loaded) {
  if (integrator.type != "moment" && integrator.type != "aov") return integrator;
  if (integrator.type == "aov") loaded.aovs = asked_aovs(integrator);
  for (const Node& child : integrator.children)
    if (child.family == "integrator") {
      if (integrator.type == "moment")
        loaded.warnings.push_back(
            at(integrator.where, "integrator 'moment' is not supported; the '{}' inside it is used",
               child.type));
      return unwrapped(child, loaded);
    }
  throw SceneError(
      at(integrator.where, "integrator '{}' has no integrator inside", integrator.type));
}

void find_integrator(const Node& scene, LoadedScene& loaded) {
  const Node* integrator = nullptr;
  for (const Node& child : scene.children) {
    if (child.family != "integrator") continue;
    if (integrator)
      throw SceneError(at(child.where, "the scene has a second integrator; keep one"));
    integrator = &child;
  }
  if (integrator) loaded.integrator = unwrapped(*integrator, loaded);
}

struct Contents {
  Builder::View view;
  std::vector<ShapePtr> shapes;
  std::vector<EmitterPtr> emitters;
};

/// Shapes and lights in the order of the scene; everything else is made too, and so checked.
Contents build_contents(const Node& scene, const Node& sensor, const std::optional<Vec2i>& size,
                        Builder& builder) {
  Contents contents{builder.view(sensor, size), {}, {}};
  auto& [view, shapes, emitters] = contents;
  std::vector<std::pair<const Node*, EmitterPtr>> unattached;
  for (const Node& child : scene.children) {
    if (child.family == "sensor" || child.family == "integrator") continue;
    if (child.family == "ref")
      throw SceneError(
          at(child.where, "a <ref> at the top of a scene has no effect; put it inside a shape"));
    if (child.family == "shape") {
      const ShapePtr shape = builder.shape(child);
      if (!shape) continue;  // a group, which is in the scene only through its instances
      shapes.push_back(shape);
      if (const EmitterPtr& light = shape->emitter_ptr()) emitters.push_back(light);
    } else if (child.family == "emitter") {
      const ObjectPtr object = builder.object(child);
      if (const auto lights = std::dynamic_pointer_cast<Lights>(object)) {
        emitters.insert(emitters.end(), lights->all.begin(), lights->all.end());
        continue;
      }
      const auto emitter = std::dynamic_pointer_cast<Emitter>(object);
      if (emitter->infinite() || emitter->delta())
        emitters.push_back(emitter);
      else
        unattached.emplace_back(&child, emitter);
    } else {
      builder.object(child);
    }
  }
  for (const auto& [node, emitter] : unattached)
    if (!builder.on_a_shape(*node))
      throw SceneError(
          at(node->where, "emitter '{}' needs a shape; put it inside one", node->type));
  if (emitters.empty())
    throw SceneError(
        at(scene.where, "the scene has no emitter, so the image would be black; add a light"));
  return contents;
}

/// Throws SceneError for scenes so small or large that single precision cannot hold their squares.
void check_extent(const Bounds& bounds, const Location& where) {
  constexpr double least = 1e-13, most = 1e13;
  if (!(bounds.radius >= least && bounds.radius <= most))
    throw SceneError(at(where,
                        "the scene has a radius of {:.3g}, but should have one between {:g} and "
                        "{:g}; choose another unit of length",
                        bounds.radius, least, most));
}

Known known_of(Builder& builder, const Known* before, std::shared_ptr<const Accel> accel) {
  Known known;
  known.parts = std::make_shared<const Parts>(builder.take_parts());
  known.accel = std::move(accel);
  if (!before) return known;
  known.file_hashes = before->file_hashes;
  for (const std::string& name : builder.files()) known.file_hashes.erase(name);
  for (const auto& [name, moved] : before->moved_files) known.file_hashes[name] = file_hash(moved);
  return known;
}

}  // namespace

LoadedScene build_scene(const Node& tree, const Registry& registry, const LoadOptions& options,
                        const Known* known) {
  const auto start = Clock::now();
  LoadedScene loaded;
  loaded.tree = options.sensor ? asking_for(tree, *options.sensor) : tree;
  if (!options.filter.empty()) {
    registry.find("rfilter", options.filter, {});
    change_films(loaded.tree, [&](Node& film) {
      film.children = {Node{"rfilter", options.filter, "", "", film.where, {}, {}}};
    });
  }
  if (options.spectral) make_spectral(loaded.tree, options.band);
  const Node& scene = loaded.tree;
  if (scene.family != "scene")
    throw SceneError(at(scene.where, "the root is a {}, but should be a scene", scene.family));
  if (options.size) check_size(*options.size);

  // New parts of a scene that has been built before are refused by the builder.
  if (!known || !known->parts) refuse_missing(scene, registry);
  const Node& sensor = chosen_sensor(scene, loaded.warnings);
  find_integrator(scene, loaded);
  const std::vector<std::string> warnings = loaded.warnings;
  std::optional<Builder> builder(std::in_place, scene, registry, loaded.warnings, known);
  Contents contents = build_contents(scene, sensor, options.size, *builder);
  const Origins origins =
      builder->better_origins(enclosing_sphere(contents.shapes, *contents.view.camera));
  if (origins.any()) {
    loaded.warnings = warnings;
    builder.emplace(scene, registry, loaded.warnings, known, origins);
    contents = build_contents(scene, sensor, options.size, *builder);
  }
  const Builder::View& view = contents.view;
  loaded.scene = std::make_shared<Scene>(std::move(contents.shapes), std::move(contents.emitters),
                                         view.camera, view.film, view.sample_count,
                                         known ? known->accel : nullptr, origins.scene);
  check_extent(loaded.scene->bounds(), scene.where);
  for (const auto& warnings : {warnings_of_coincident_lights(*loaded.scene),
                               warnings_of_crossing_boundaries(*loaded.scene)})
    loaded.warnings.insert(loaded.warnings.end(), warnings.begin(), warnings.end());
  builder->show_shapes(loaded.scene->shapes());
  loaded.size = options.size;
  loaded.known = known_of(*builder, known, loaded.scene->accel_ptr());
  loaded.hash = fingerprint(scene, options.size, loaded.known.file_hashes);
  loaded.seconds = seconds_since(start);
  return loaded;
}

LoadedScene build_again(const LoadedScene& loaded, const Node& tree, const Registry& registry) {
  LoadOptions options;
  options.size = loaded.size;
  LoadedScene other = build_scene(tree, registry, options, &loaded.known);
  other.reading_warnings = loaded.reading_warnings;
  other.warnings.insert(other.warnings.begin(), other.reading_warnings.begin(),
                        other.reading_warnings.end());
  return other;
}

LoadedScene with_sensor(const LoadedScene& loaded, int64_t sensor, const Registry& registry) {
  LoadedScene other = build_again(loaded, asking_for(loaded.tree, sensor), registry);
  other.source = loaded.source;
  other.source.options.sensor = sensor;
  return other;
}

LoadedScene with_wavelengths(const LoadedScene& loaded, const std::string& band,
                             const Registry& registry) {
  Node tree = loaded.tree;
  make_spectral(tree, band);
  LoadedScene other = build_again(loaded, tree, registry);
  other.source = loaded.source;
  other.source.options.spectral = true;
  if (!band.empty()) other.source.options.band = band;
  return other;
}

ObjectPtr build_object(const Node& node, const Registry& registry,
                       std::vector<std::string>& warnings) {
  return Builder(node, registry, warnings).object(node);
}

namespace {

template <class Read>
LoadedScene load(SceneSource source, const Read& read, const Registry& registry,
                 const LoadOptions& options) {
  const auto start = Clock::now();
  std::vector<std::string> warnings;
  Node tree = read(warnings);
  if (options.lenient.value_or(!tree.modern)) leave_out_unknown(tree, registry, warnings);
  LoadedScene loaded = build_scene(tree, registry, options);
  loaded.warnings.insert(loaded.warnings.begin(), warnings.begin(), warnings.end());
  loaded.reading_warnings = std::move(warnings);
  source.options = options;
  loaded.source = std::move(source);
  loaded.seconds = seconds_since(start);
  return loaded;
}

}  // namespace

LoadedScene load_file(const std::string& path, const Registry& registry,
                      const LoadOptions& options) {
  if (is_stream(path)) return load_string(read_stream(path), ".", registry, options);
  std::error_code ignored;
  const std::string absolute = std::filesystem::absolute(path, ignored).string();
  return load(
      {SceneSource::Kind::file, absolute, "", {}},
      [&](auto& warnings) { return read_xml_file(path, options, warnings); }, registry, options);
}

LoadedScene load_string(const std::string& xml, const std::string& directory,
                        const Registry& registry, const LoadOptions& options) {
  std::error_code ignored;
  const std::string absolute = std::filesystem::absolute(directory, ignored).string();
  return load(
      {SceneSource::Kind::text, xml, absolute, {}},
      [&](auto& warnings) { return read_xml_string(xml, directory, options, warnings); }, registry,
      options);
}

}  // namespace mlt
