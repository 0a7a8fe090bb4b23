// The first ray of a walk from the camera.
#pragma once

#include "scene/scene.h"

namespace mlt {

/// The ray through a raster position, from a point on the lens, at a moment. `start`, if given,
/// becomes that point.
template <class Sampler>
Ray camera_ray(const Camera& camera, const Vec2& raster, Sampler& sampler,
               SurfacePoint* start = nullptr) {
  const SurfacePoint lens = camera.sample_position(sampler.next2()).at;
  if (start) *start = lens;
  return {lens.p, camera.direction(lens, raster), camera.time(sampler.next())};
}

}  // namespace mlt
