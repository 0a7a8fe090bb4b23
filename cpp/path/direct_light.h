// Next-event estimation: light from a position that is sampled on a light (Veach 1997, sec. 8.3.2).
#pragma once

#include "path/walk.h"

namespace mlt {

/// d(measure of x0) / d(solid angle of w at `from`): turns a density at x0 into one over
/// directions. w points from `from` to x0.
inline double per_solid_angle(const Vec3& from, const SurfacePoint& x0, const Vec3& w) {
  if (x0.infinite()) return 1;
  return length_squared(x0.p - from) / abs_cos(x0, w);
}

/// Density in solid angle with which next-event estimation at `from` samples x0, in direction w, if
/// it chooses this light with this probability.
inline double direct_pdf(double choice, const Emitter& emitter, const Vec3& from,
                         const SurfacePoint& x0, const Vec3& w) {
  return choice * emitter.pdf_direct(from, x0) * per_solid_angle(from, x0, w);
}
inline double direct_pdf(const Scene& scene, const Emitter& emitter, const Vec3& from,
                         const SurfacePoint& x0, const Vec3& w) {
  const double choice = scene.emitter_probability_for(emitter.index(), from);
  return direct_pdf(choice, emitter, from, x0, w);
}

/// The light from a position sampled by next-event estimation that is scattered at a point, if it
/// is visible from there.
struct DirectLight {
  Spectrum radiance{0};
  bool disperses = false;  ///< See Scattering.
};

/// The light that is scattered at `at` towards the camera, without visibility; `scattering(wl)` is
/// that between the direction to the light and the camera, `weight(pdf_light, pdf_bsdf)` the MIS
/// weight, of densities in solid angle.
template <class Scatter, class Weight>
DirectLight unshadowed_light(const LightSample& light, const SurfacePoint& at, bool strict,
                             Scatter&& scattering, Weight&& weight) {
  if (!(light.x0.pdf > 0)) return {};
  const Vec3 wl = direction(at, light.x0.at);
  if (!consistent_sides(at, wl, strict)) return {};
  const Spectrum radiance = light.emitted(-wl);
  if (is_black(radiance)) return {};
  const WorldScattering s = scattering(wl);
  if (is_black(s.f)) return {};
  const double pdf = light.x0.pdf * per_solid_angle(at.p, light.x0.at, wl);
  const double mis = weight(pdf, light.emitter->delta() ? 0 : s.pdf_from_camera);
  return {radiance * s.f * (std::abs(s.cos_l) * mis / pdf), s.disperses};
}

/// The light that is scattered at `at` towards wc from this position, with visibility. A walk would
/// go on from `at` with this likelihood.
template <class Weight>
DirectLight direct_light(const Walker& walker, const SurfacePoint& at, const Vec3& wc,
                         const LightSample& chosen, bool strict, Weight&& weight,
                         const Spectrum& likelihood = Spectrum(1)) {
  const Scene& scene = walker.scene;
  const auto scattering = [&](const Vec3& wl) {
    return BsdfAt(scene, at).scattering(wl, wc, Lobe::smooth);
  };
  if (!scene.has_passages()) {
    const DirectLight light = unshadowed_light(chosen, at, strict, scattering, weight);
    return !is_black(light.radiance) && walker.sees(at, chosen.x0.at) ? light : DirectLight();
  }
  if (!(chosen.x0.pdf > 0)) return {};
  const SurfacePoint& x0 = chosen.x0.at;
  const Passage seen = walker.passage(at, x0);
  if (seen.is_blocked()) return {};
  const double arrives = scene.arrival(seen, x0, direction(at, x0)).after(likelihood).probability();
  const auto through = [&](double light, double bsdf) { return weight(light, bsdf * arrives); };
  DirectLight light = unshadowed_light(chosen, at, strict, scattering, through);
  light.radiance *= seen.transmittance;
  return light;
}

}  // namespace mlt
