// A thin layer of a medium, by single scattering (Hanrahan & Krueger 1993, "Reflection from layered
// surfaces due to subsurface scattering", sec. 5): with the albedo W, the phase function p, the
// optical thickness tau, and l = |cos wl|, c = |cos wc|,
//   f = W p (1 - exp(-tau (1 / l + 1 / c))) / (l + c)       on the same side,
//   f = W p (exp(-tau / l) - exp(-tau / c)) / (l - c)       on the other side,
// and exp(-tau / c) goes straight through. Light that is scattered twice is lost.
#include "base/registry.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/medium/coefficients.h"
#include "scene/phase/isotropic.h"

namespace mlt {
namespace {

class HanrahanKrueger final : public Bsdf {
 public:
  explicit HanrahanKrueger(Params& params)
      : coefficients_(params),
        thickness_(params.real_in("thickness", 0, 1e9)),
        phase_(phase_param(params)) {}

  Passage passage(const SurfacePoint& at, const Vec3& w) const override {
    const Spectrum passed = exp(-thickness(at) / std::abs(w.z));
    return {passed, target_luminance(passed)};
  }
  bool has_passage() const override { return true; }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (wl.z * wc.z == 0) return {};
    Scattering s = phase_->scattering(at, wl, wc, lobe);
    const double l = std::abs(wl.z), c = std::abs(wc.z);
    s.f *= albedo(at) *
           (same_side(wl, wc) ? reflected(thickness(at), l, c) : transmitted(thickness(at), l, c));
    return s;
  }
  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    const auto sampled = phase_->sample(at, from, u);
    return sampled && sampled->to.z * from.z != 0 ? sampled : std::nullopt;
  }
  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (from.z * to.z == 0) return std::nullopt;
    return phase_->invert(at, from, to, lobe, v);
  }

  bool has_transmission() const override { return true; }
  Spectrum albedo(const SurfacePoint& at) const override {
    const auto [extinction, scattering] = coefficients_.at(at.wavelength);
    return scattering / max(extinction, Spectrum(1e-300));
  }

 private:
  /// tau.
  Spectrum thickness(const SurfacePoint& at) const {
    return thickness_ * coefficients_.at(at.wavelength).extinction;
  }
  static Spectrum reflected(const Spectrum& tau, double l, double c) {
    return (Spectrum(1) - exp(-tau * (1 / l + 1 / c))) / (l + c);
  }
  /// The quotient of differences is the derivative where l = c.
  static Spectrum transmitted(const Spectrum& tau, double l, double c) {
    if (std::abs(l - c) < 1e-5 * (l + c)) {
      const double mean = 0.5 * (l + c);
      return tau / sqr(mean) * exp(-tau / mean);
    }
    return (exp(-tau / l) - exp(-tau / c)) / (l - c);
  }

  Coefficients coefficients_;
  double thickness_;
  BsdfPtr phase_;
};

}  // namespace

Plugin bsdf_hk() {
  return make_plugin<HanrahanKrueger>(
      "bsdf", "hk", "A thin layer of a medium, by single scattering (Hanrahan & Krueger 1993).",
      concat({coefficient_parameters(),
              {{"thickness", ParamType::real, 1.0, "Of the layer, in the unit of length."}}}));
}

}  // namespace mlt
