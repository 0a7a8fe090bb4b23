#include "rendering/hidden_lights.h"

#include "base/rng.h"
#include "path/walk.h"

#include <fmt/format.h>

namespace mlt {
namespace {

/// Whether all surfaces that the light illuminates are perfectly specular, tested by a few rays.
bool is_hidden(const Scene& scene, const Emitter& light) {
  constexpr int rays = 256;
  Rng rng(0, Purpose::inspect, light.index());
  const double time = scene.camera().time(0.5);
  RayCounts count;
  const Walker walker{scene, time, count};
  bool shines = false;
  for (int i = 0; i < rays; ++i) {
    const Vec2 u_position{rng.next(), rng.next()}, u_direction{rng.next(), rng.next()};
    const Vertex x0 = light_vertex(light, light.sample_position(u_position, time).at);
    const Departure first = walker.emitted_ray(x0, u_direction);
    SurfacePoint at;
    if (!(first.pdf > 0) || !walker.arrive(first.ray, 0, at)) continue;
    if (scene.bsdf(at).has_smooth()) return false;
    shines = true;
  }
  return shines;
}

}  // namespace

void warn_of_hidden_lights(const Scene& scene, Stats& stats) {
  for (const EmitterPtr& light : scene.emitters())
    if (light->delta_direction())
      stats.warnings.push_back(
          fmt::format("{} cannot find the light of emitter '{}', which shines along its normals "
                      "alone; use bdpt or mlt",
                      stats.integrator, light->type));
  for (const EmitterPtr& light : scene.emitters())
    if (light->delta() && is_hidden(scene, *light))
      stats.warnings.push_back(
          fmt::format("{} cannot find the light of emitter '{}', which has no size and shines "
                      "through mirrors or glass alone; use bdpt or mlt",
                      stats.integrator, light->type));
}

}  // namespace mlt
