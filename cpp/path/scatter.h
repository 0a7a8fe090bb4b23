// One scattering event of a walk from the camera, in world space.
#pragma once

#include "scene/bsdf.h"
#include "scene/surface_point.h"

#include <optional>

namespace mlt {

/// Light leaks through or vanishes where the geometric and the shading normal see a direction on
/// different sides. By default the shading normal alone decides; `strict` refuses such directions.
inline bool consistent_sides(const SurfacePoint& at, const Vec3& w, bool strict) {
  return !strict || dot(at.ng, w) * dot(at.shading.n, w) > 0;
}

struct ScatterSample {
  Vec3 w;        ///< Towards the light side.
  Color weight;  ///< Of radiance: f |cos| / pdf.
  double pdf;    ///< Solid angle, or the probability of the delta lobe.
  Lobe lobe;
  double eta2;  ///< The factor of radiance in `weight` that is due to refraction alone.
};

/// Samples the direction from which the light that goes on along wc may have come.
inline std::optional<ScatterSample> scatter_to_light(const Bsdf& bsdf, const SurfacePoint& at,
                                                     const Vec3& wc, const Vec3& u, bool strict) {
  const Vec3 local_c = at.shading.to_local(wc);
  const auto sample = bsdf.sample(at, local_c, u);
  if (!sample) return std::nullopt;
  const Vec3 w = at.shading.to_world(sample->to);
  if (sample->lobe != Lobe::null && !consistent_sides(at, w, strict)) return std::nullopt;
  const Scattering s = bsdf.scattering(at, sample->to, local_c, sample->lobe);
  if (!(s.pdf_from_camera > 0) || is_black(s.f)) return std::nullopt;

  const bool refracted = sample->lobe == Lobe::transmission ||
                         (sample->lobe == Lobe::smooth && !same_side(sample->to, local_c));
  const double eta2 = refracted ? sqr(bsdf.relative_eta(at, local_c)) : 1.0;
  const double factor = sample->lobe == Lobe::smooth ? abs_cos_theta(sample->to) : eta2;
  return ScatterSample{w, s.f * (factor / s.pdf_from_camera), s.pdf_from_camera, sample->lobe,
                       eta2};
}

}  // namespace mlt
