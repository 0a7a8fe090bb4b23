// The phase function of Henyey & Greenstein 1941, "Diffuse radiation in the galaxy":
// p(cos) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)), whose mean cosine is g.
#include "scene/phase/phase_function.h"

namespace mlt {
namespace {

class HenyeyGreenstein final : public PhaseFunction<HenyeyGreenstein> {
 public:
  static constexpr bool lanes = true;

  explicit HenyeyGreenstein(Params& params) : g_(params.real_in("g", -0.999, 0.999)) {
    supports_lanes_ = std::abs(g_) < 0.95;  // single precision is not enough for narrower ones
  }

  template <class F>
  F density(const F& cosine) const {
    const F g = number<F>(g_), d = 1 + g * g - 2 * g * cosine;
    return number<F>((1 - g_ * g_) * 0.25 * inv_pi) / (d * sqrt(d));
  }
  /// With s = (1 - g^2) / (1 + g - 2 g u): cos = (1 + g^2 - s^2) / (2 g). Written with (s - 1) / g,
  /// so that a small g keeps its digits.
  template <class F>
  F sample_cosine(const F& u) const {
    const F g = number<F>(g_), half_g = number<F>(0.5 * g_);
    const F over_g = (2 * u - 1 - g) / (1 + g - 2 * g * u);  // (s - 1) / g
    return half_g - over_g - half_g * over_g * over_g;
  }
  double invert_cosine(double cosine) const {
    const double s = std::sqrt(1 + g_ * g_ - 2 * g_ * cosine);
    const double over_g = (g_ - 2 * cosine) / (s + 1);  // (s - 1) / g
    return 0.5 * (1 + g_) * (1 + over_g) / s;
  }

 private:
  double g_;
};

}  // namespace

Plugin phase_hg() {
  return make_plugin<HenyeyGreenstein>(
      "phase", "hg", "Scatters light mostly forward or backward (Henyey & Greenstein 1941).",
      {{"g", ParamType::real, 0.8,
        "Mean cosine of the deflection, -0.999 to 0.999: 0 is isotropic, positive is forward."}});
}

}  // namespace mlt
