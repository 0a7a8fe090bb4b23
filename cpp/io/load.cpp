#include "io/load.h"

#include "base/atomic_file.h"
#include "io/batches.h"
#include "io/builder.h"
#include "io/families.h"
#include "io/leniency.h"
#include "io/missing.h"
#include "io/node_bytes.h"
#include "io/view_nodes.h"
#include "scene/emitter/daylight.h"
#include "scene/emitter/volume_light.h"
#include "scene/light/coincident_lights.h"
#include "scene/medium/crossing_boundaries.h"

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
  const std::vector<EmitterPtr> glowing = volume_lights(shapes);
  emitters.insert(emitters.end(), glowing.begin(), glowing.end());
  for (const auto& [node, emitter] : unattached)
    if (!builder.on_a_shape(*node))
      throw SceneError(
          at(node->where, "emitter '{}' needs a shape; put it inside one", node->type));
  if (view.camera->lacks_shape())
    throw SceneError(at(sensor.where, "sensor '{}' needs a shape; put it inside one", sensor.type));
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

/// Whether an integrator shows surfaces, and no light.
bool needs_no_light(const Node& integrator) {
  return integrator.type == "aov" || integrator.type == "depth";
}

}  // namespace

LoadedScene build_scene(const Node& tree, const Registry& registry, const LoadOptions& options,
                        const Known* known) {
  const auto start = Clock::now();
  LoadedScene loaded;
  loaded.tree = without_batches(tree, registry);
  if (options.sensor) loaded.tree = asking_for(std::move(loaded.tree), *options.sensor);
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
  if (contents.emitters.empty()) {
    contents.emitters.push_back(builder->black_light(scene.where));
    if (!loaded.integrator || !needs_no_light(*loaded.integrator))
      loaded.warnings.push_back(
          at(scene.where, "the scene has no emitter, so the image is black; add a light"));
  }
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
