// Next-event estimation: a light, and a position on it, chosen to be seen from a given point.
#pragma once

#include "scene/scene.h"

namespace mlt {

struct EmitterSample {
  const Emitter* emitter = nullptr;
  SurfacePoint x0;
  double pdf = 0;  ///< In the measure of x0, the choice of the light included. 0: failed.
};

/// u.x chooses the light, (u.y, u.z) the position on it.
inline EmitterSample sample_emitter(const Scene& scene, const Vec3& from, Vec3 u) {
  const EmitterChoice choice = scene.choose_emitter(u.x);
  const PositionSample position = choice.emitter->sample_direct(from, {u.y, u.z});
  return {choice.emitter, position.at, choice.probability * position.pdf};
}

/// The density with which sample_emitter chooses x0 on `emitter`.
inline double emitter_pdf(const Scene& scene, const Emitter& emitter, const Vec3& from,
                          const SurfacePoint& x0) {
  return scene.emitter_probability(emitter.index()) * emitter.pdf_direct(from, x0);
}

/// d(measure of x0) / d(solid angle of w at `from`): turns a density at x0 into one over directions.
/// w points from `from` to x0.
inline double per_solid_angle(const Vec3& from, const SurfacePoint& x0, const Vec3& w) {
  if (x0.infinite()) return 1;
  return length_squared(x0.p - from) / abs_cos(x0, w);
}

}  // namespace mlt
