#include "job/empty_image.h"

#include "base/rng.h"
#include "path/samplers.h"
#include "path/walk.h"

#include <algorithm>
#include <map>

namespace mlt {
namespace {

constexpr int rays = 1024;

/// What the rays hit.
struct View {
  int hits = 0;
  std::map<uint32_t, int> from_behind;  ///< Hits of the back of each shape.
};

View look(const Scene& scene) {
  Rng rng(0, Purpose::inspect, 0);
  RandomSampler sampler(rng);
  View view;
  for (int i = 0; i < rays; ++i) {
    const Vec2 raster = scene.camera().raster().sample(sampler.next2());
    const Ray ray = camera_ray(scene.camera(), raster, sampler).ray;
    SurfacePoint at;
    if (!scene.intersect(ray, at)) continue;
    ++view.hits;
    if (dot(at.ng, ray.d) > 0) ++view.from_behind[at.shape];
  }
  return view;
}

std::string name_of(const Object& object) {
  const std::string place = describe(object.where);
  return fmt::format("the {} '{}'{}", object.type, object.id, place.empty() ? "" : ", " + place);
}

}  // namespace

std::string cause_of_darkness(const Scene& scene) {
  if (scene.shapes().empty()) return "the scene has no shapes";
  const View view = look(scene);
  if (view.hits == 0)
    return fmt::format(
        "nothing is in view, since none of {} rays from the lens meets a shape; check the sensor's "
        "to_world, which looks along +z",
        rays);
  for (const auto& [shape, hits] : view.from_behind)
    if (hits > 0.95 * rays)
      return fmt::format("the lens is inside {}, whose back is all it sees; move the sensor",
                         name_of(*scene.shapes()[shape]));
  return fmt::format(
      "no light was found, though {} of {} rays from the lens meet shapes; check that light can "
      "reach what is seen, and that max_depth allows it",
      view.hits, rays);
}

}  // namespace mlt
