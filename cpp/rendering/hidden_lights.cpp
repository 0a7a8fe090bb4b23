#include "rendering/hidden_lights.h"

#include "base/rng.h"
#include "path/samplers.h"
#include "path/subpath.h"

#include <fmt/format.h>

#include <algorithm>

namespace mlt {
namespace {

/// For each light without a size: the share of all light that it sends by way of mirrors or glass
/// to the first surface which scatters it smoothly. Estimated by walks from the lights.
std::vector<double> hidden_shares(const Scene& scene) {
  constexpr int walks = 4096, most_vertices = 10;
  Rng rng(0, Purpose::inspect, 0);
  RandomSampler sampler(rng);
  RayCounts count;
  const Camera& camera = scene.camera();
  Subpath walk(Subpath::From::light);
  std::vector<double> hidden(scene.emitters().size(), 0.0);
  double all = 0;
  for (int i = 0; i < walks; ++i) {
    const double wavelength = camera.wavelength([&] { return sampler.next(); });
    const Walker walker{scene, camera.time(0.5), count, wavelength};
    walk_from_light(walker, {}, {most_vertices, true}, sampler, walk);
    size_t first = 1;
    while (first < walk.size() && walk[first].vertex.delta()) ++first;
    if (first >= walk.size()) continue;
    const double power = max_component(walk[first].throughput);
    const uint32_t light = walk[0].vertex.emitter;
    all += power;
    if (first > 1 && scene.emitters()[light]->delta()) hidden[light] += power;
  }
  for (double& power : hidden) power /= all > 0 ? all : 1;
  return hidden;
}

}  // namespace

const Emitter* lamp_on_lens(const Scene& scene) {
  const Camera& camera = scene.camera();
  const bool on_a_shape = !camera.delta_position() && camera.lens_radius() == 0;
  for (const EmitterPtr& light : scene.emitters())
    if (on_a_shape && light->delta()) return light.get();
  return nullptr;
}

void warn_of_hidden_lights(const Scene& scene, Stats& stats) {
  constexpr double least = 0.005;
  const auto& lights = scene.emitters();
  for (const EmitterPtr& light : lights)
    if (light->delta_direction())
      stats.warnings.push_back(
          fmt::format("{} cannot find the light of emitter '{}', which shines along its normals "
                      "alone; use bdpt or mlt",
                      stats.integrator, light->type));
  if (const Emitter* lamp = lamp_on_lens(scene))
    stats.warnings.push_back(
        fmt::format("{} cannot find the light of emitter '{}' that falls straight on the sensor's "
                    "shape, since that emitter has no size; use bdpt or mlt",
                    stats.integrator, lamp->type));
  if (std::none_of(lights.begin(), lights.end(), [](const auto& light) { return light->delta(); }))
    return;
  const std::vector<double> shares = hidden_shares(scene);
  for (size_t i = 0; i < lights.size(); ++i)
    if (shares[i] > least)
      stats.warnings.push_back(fmt::format(
          "{} cannot find the light of emitter '{}' that comes by way of mirrors or glass, about "
          "{:.2g} % of all light, since that emitter has no size; use bdpt or mlt",
          stats.integrator, lights[i]->type, 100 * shares[i]));
}

}  // namespace mlt
