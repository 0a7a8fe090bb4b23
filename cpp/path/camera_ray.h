// The first ray of a walk from the camera.
#pragma once

#include "scene/scene.h"

namespace mlt {

/// The ray through a raster position, from a point on the lens, at a moment; all but the raster
/// position from uniform numbers.
inline Ray camera_ray(const Camera& camera, const Vec2& raster, const Vec2& u_lens, double u_time) {
  const SurfacePoint lens = camera.sample_position(u_lens).at;
  return {lens.p, camera.direction(lens, raster), camera.time(u_time)};
}

}  // namespace mlt
