// The common part of phase functions that depend on the angle of deflection alone. They are Bsdfs
// without a surface: values and densities are per solid angle, and f is the density itself, the
// same from both sides.
//
// A model of one has, by the cosine of the deflection (1 is straight on), over numbers F that are
// double or, if it supports lanes, Float8:
//
//   F      density(cosine)         per solid angle
//   F      sample_cosine(u)
//   double invert_cosine(cosine)
#pragma once

#include "base/registry.h"
#include "math/warp.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/bsdf/scattering_lanes.h"

namespace mlt {

template <class Model>
class PhaseFunction : public Bsdf {
 public:
  Scattering scattering(const SurfacePoint&, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const final {
    if (lobe != Lobe::smooth) return {};
    const double p = model().density(-dot(wl, wc));
    return {Spectrum(p), p, p};
  }
  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const final {
    return BsdfSample{deflected(from, model().sample_cosine(u.y), u.z), Lobe::smooth};
  }
  std::optional<Vec3> invert(const SurfacePoint&, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const final {
    if (lobe != Lobe::smooth) return std::nullopt;
    const Vec3 local = Frame::around(-from).to_local(to);
    return u_of(v.x, {model().invert_cosine(local.z), turns(local.x, local.y)});
  }
  void scatter(ScatteringLanes& x) const final {
    if constexpr (Model::lanes) {
      x.fill_up();
      for (int i = 0; i < x.count; i += 8) scatter_eight(x, i);
    }
  }
  Spectrum albedo(const SurfacePoint&) const final { return Spectrum(1); }
  bool has_transmission() const final { return true; }

 private:
  /// The direction that deflects light from `from`, at an azimuth in turns.
  template <class F>
  static Vec3Of<F> deflected(const Vec3Of<F>& from, const F& sampled, const F& azimuth) {
    const F cosine = min(max(sampled, F(-1)), F(1));
    const SinCosOf<F> phi = sincos_turns(azimuth);
    const F sine = sqrt((1 - cosine) * (1 + cosine));
    return FrameOf<F>::around(-from).to_world({sine * phi.cos, sine * phi.sin, cosine});
  }
  void scatter_eight(ScatteringLanes& x, int first) const {
    const Vec3Of<Float8> wc = x.wc.eight(first), wl = x.wl.eight(first);
    const Float8 cosine = model().sample_cosine(x.u_x.eight(first));
    const Float8 light = select(dot(wl, wl) > 0, model().density(-dot(wl, wc)), Float8(0)),
                 next = model().density(cosine);
    x.pdf_light.set_eight(first, light);
    x.pdf.set_eight(first, next);
    x.to.set_eight(first, deflected(wc, cosine, x.u_y.eight(first)));
    for (int lane = 0, i = first; lane < 8 && i < x.count; ++lane, ++i) {
      x.f_light[i] = Spectrum(double{light[lane]});
      x.f[i] = Spectrum(double{next[lane]});
    }
  }
  const Model& model() const { return static_cast<const Model&>(*this); }
};

}  // namespace mlt
