// The base of one-sided materials that are sampled like Lambert's: with the density cos / pi,
// whatever the value of the BSDF.
#pragma once

#include "math/warp.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/lobes.h"

namespace mlt {

class CosineSampled : public Bsdf {
 public:
  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const final {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    return {value(at, wl, wc), wc.z * inv_pi, wl.z * inv_pi};
  }

  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const final {
    const Vec3 to = sample_cosine_hemisphere(direction_part(u));
    if (!above(from, to)) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }

  std::optional<Vec3> invert(const SurfacePoint&, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const final {
    if (lobe != Lobe::smooth || !above(from, to)) return std::nullopt;
    return u_of(v.x, invert_cosine_hemisphere(to));
  }

 protected:
  /// f between two directions above the surface.
  virtual Spectrum value(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const = 0;
};

}  // namespace mlt
