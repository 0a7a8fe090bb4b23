#include "scene/light/coincident_lights.h"

#include "base/rng.h"
#include "math/warp.h"
#include "scene/scene.h"

#include <set>

namespace mlt {
namespace {

/// The other shape that a short ray along -w meets at a point of the light's surface, or nullptr.
const Shape* found_at(const Scene& scene, const Emitter& light, const SurfacePoint& y,
                      const Vec3& w) {
  const double reach = 4 * ray_offset * std::max(y.extent, 1e-3 * scene.bounds().radius);
  const Ray ray{y.p + w * reach, -w, y.time, 2 * reach};
  SurfacePoint at;
  if (!scene.intersect(ray, at) || scene.emitter(at) == &light) return nullptr;
  const uint32_t shape = at.instance == SurfacePoint::no_shape ? at.shape : at.instance;
  return scene.shapes()[shape].get();
}

/// Which shapes lie in the surface of the light, tested at some of its points by rays from all
/// sides: a ray meets one of two surfaces in one place, as rounding has it.
std::set<const Shape*> coincident_shapes(const Scene& scene, const Emitter& light) {
  constexpr int points = 128;
  Rng rng(0, Purpose::inspect, light.index());
  std::set<const Shape*> found;
  for (int i = 0; i < points; ++i) {
    const Vec2 u{rng.next(), rng.next()};
    const SurfacePoint y = light.sample_position(u, scene.camera().time(0.5)).at;
    const Vec3 w = sample_uniform_sphere({rng.next(), rng.next()});
    if (std::abs(dot(w, y.ng)) < 0.5) continue;
    if (const Shape* shape = found_at(scene, light, y, w)) found.insert(shape);
  }
  return found;
}

}  // namespace

std::vector<std::string> warnings_of_coincident_lights(const Scene& scene) {
  std::vector<std::string> warnings;
  std::set<const Shape*> named;
  for (const EmitterPtr& light : scene.emitters()) {
    const Shape* own = light->shape();
    if (!own) continue;
    for (const Shape* other : coincident_shapes(scene, *light)) {
      if (named.count(own) && named.count(other)) continue;
      named.insert({own, other});
      const std::string place = describe(other->where);
      warnings.push_back(
          at(own->where,
             "this light lies in the same place as another shape, at least partly{}; "
             "which of the two is seen is left to rounding, so move one",
             place.empty() ? "" : " (" + place + ")"));
    }
  }
  return warnings;
}

}  // namespace mlt
