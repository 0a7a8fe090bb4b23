// The common part of phase functions that depend on the angle of deflection alone. They are Bsdfs
// without a surface: values and densities are per solid angle, and f is the density itself, the
// same from both sides.
#pragma once

#include "base/registry.h"
#include "math/warp.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/lobes.h"

namespace mlt {

class PhaseFunction : public Bsdf {
 public:
  Scattering scattering(const SurfacePoint&, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const final {
    if (lobe != Lobe::smooth) return {};
    const double p = density(-dot(wl, wc));
    return {Spectrum(p), p, p};
  }
  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const final {
    const double cosine = glm::clamp(sample_cosine(u.y), -1.0, 1.0);
    const SinCos phi = sincos_turns(u.z);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const Vec3 to{sine * phi.cos, sine * phi.sin, cosine};
    return BsdfSample{Frame::around(-from).to_world(to), Lobe::smooth};
  }
  std::optional<Vec3> invert(const SurfacePoint&, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const final {
    if (lobe != Lobe::smooth) return std::nullopt;
    const Vec3 local = Frame::around(-from).to_local(to);
    return u_of(v.x, {invert_cosine(local.z), turns(local.x, local.y)});
  }
  Spectrum albedo(const SurfacePoint&) const final { return Spectrum(1); }
  bool has_transmission() const final { return true; }

 protected:
  /// Per solid angle, by the cosine of the deflection: 1 is straight on.
  virtual double density(double cosine) const = 0;
  virtual double sample_cosine(double u) const = 0;
  virtual double invert_cosine(double cosine) const = 0;
};

}  // namespace mlt
