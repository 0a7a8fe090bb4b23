#include "io/load.h"

#include "image/atomic_file.h"
#include "io/builder.h"
#include "io/families.h"
#include "io/leniency.h"
#include "io/node_bytes.h"

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

const Node& only_sensor(const Node& scene, std::vector<std::string>& warnings) {
  const Node* sensor = nullptr;
  for (const Node& child : scene.children) {
    if (child.family != "sensor") continue;
    if (sensor)
      warnings.push_back(
          at(child.where, "this scene has several sensors; only the first one is used"));
    else
      sensor = &child;
  }
  if (!sensor)
    throw SceneError(at(scene.where, "the scene has no sensor; add <sensor type=\"perspective\">"));
  return *sensor;
}

/// Mitsuba's integrators that only add statistics or channels to the one nested in them.
const Node& unwrapped(const Node& integrator, std::vector<std::string>& warnings) {
  if (integrator.type != "moment" && integrator.type != "aov") return integrator;
  for (const Node& child : integrator.children)
    if (child.family == "integrator") {
      warnings.push_back(at(integrator.where,
                            "integrator '{}' is not supported; the '{}' inside it is used",
                            integrator.type, child.type));
      return unwrapped(child, warnings);
    }
  throw SceneError(
      at(integrator.where, "integrator '{}' has no integrator inside", integrator.type));
}

std::optional<Node> only_integrator(const Node& scene, std::vector<std::string>& warnings) {
  const Node* integrator = nullptr;
  for (const Node& child : scene.children) {
    if (child.family != "integrator") continue;
    if (integrator)
      throw SceneError(at(child.where, "the scene has a second integrator; keep one"));
    integrator = &child;
  }
  if (!integrator) return std::nullopt;
  return unwrapped(*integrator, warnings);
}

/// Shapes and lights in the order of the scene; everything else is made too, and so checked.
void build_contents(const Node& scene, Builder& builder, std::vector<ShapePtr>& shapes,
                    std::vector<EmitterPtr>& emitters) {
  std::vector<std::pair<const Node*, EmitterPtr>> unattached;
  for (const Node& child : scene.children) {
    if (child.family == "sensor" || child.family == "integrator") continue;
    if (child.family == "ref")
      throw SceneError(
          at(child.where, "a <ref> at the top of a scene has no effect; put it inside a shape"));
    if (child.family == "shape") {
      shapes.push_back(builder.shape(child));
      if (const EmitterPtr& light = shapes.back()->emitter_ptr()) emitters.push_back(light);
    } else if (child.family == "emitter") {
      const auto emitter = std::dynamic_pointer_cast<Emitter>(builder.object(child));
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
}

}  // namespace

LoadedScene build_scene(const Node& scene, const Registry& registry, const LoadOptions& options) {
  const auto start = Clock::now();
  if (scene.family != "scene")
    throw SceneError(at(scene.where, "the root is a {}, but should be a scene", scene.family));
  if (options.size) check_size(*options.size);

  LoadedScene loaded;
  const Node& sensor = only_sensor(scene, loaded.warnings);
  loaded.integrator = only_integrator(scene, loaded.warnings);
  Builder builder(scene, registry, loaded.warnings);
  const Builder::View view = builder.view(sensor, options.size);
  std::vector<ShapePtr> shapes;
  std::vector<EmitterPtr> emitters;
  build_contents(scene, builder, shapes, emitters);
  loaded.scene = std::make_shared<Scene>(std::move(shapes), std::move(emitters), view.camera,
                                         view.film, view.sample_count);
  builder.show_shapes(loaded.scene->shapes());
  loaded.tree = scene;
  loaded.size = options.size;
  loaded.hash = fingerprint(scene, options.size);
  loaded.seconds = seconds_since(start);
  return loaded;
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
