#include "integrator/one_ray.h"

#include "base/error.h"

#include <fmt/format.h>

namespace mlt {

void refuse_one_ray(const Scene& scene) {
  const Camera& camera = scene.camera();
  const SurfacePoint xk = camera.sample_position(Vec2(0.5), camera.time(0.5)).at;
  const Vec3 w = camera.direction(xk, camera.raster().sample(Vec2(0.5)));
  const auto& [center, radius] = scene.bounds();
  // What the image covers where the scene is, as a share of the scene's size.
  const double distance2 = std::max(length_squared(center - xk.p), sqr(radius));
  constexpr double least = 0x1p-40;
  if (distance2 < least * sqr(radius) * camera.pdf_direction(xk, w))
    throw UsageError(fmt::format(
        "light tracing cannot render by the sensor '{}', since no walk from a light comes to its "
        "one ray; use path, bdpt or mlt",
        camera.type));
}

}  // namespace mlt
