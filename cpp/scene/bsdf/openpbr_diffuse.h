// The diffuse base of OpenPBR: Oren and Nayar's rough surface in Fujii's form, with the light
// between its facets given back (Portsmouth, Kutz & Hill 2025, "EON: A practical energy-preserving
// rough diffuse BRDF"; OpenPBR Surface 1.1, "Glossy-diffuse").
#pragma once

#include "math/frame.h"
#include "math/number.h"
#include "math/spectrum.h"

namespace mlt {

/// Values over colours: f = rho once + rho_ms twice.
template <class F>
struct RoughDiffuseTerms {
  F once, twice;
};

template <class F>
class EnergyPreservingOrenNayar {
 public:
  explicit EnergyPreservingOrenNayar(F roughness) : roughness_(roughness) {}

  RoughDiffuseTerms<F> eval(const Vec3Of<F>& wl, const Vec3Of<F>& wc) const {
    const F s = wl.x * wc.x + wl.y * wc.y;  // wl . wc - cos_l cos_c
    const F t = select(s > 0, max(wl.z, wc.z), F(1));
    const F lost = (1 - albedo(wl.z)) * (1 - albedo(wc.z)), mean_lost = 1 - mean_albedo();
    return {
        number<F>(inv_pi) * a() * (1 + roughness_ * s / t),
        select(mean_lost > 0, number<F>(inv_pi) * lost / max(mean_lost, number<F>(1e-6)), F(0))};
  }
  /// A of Fujii's form; B is the roughness times it.
  F a() const { return 1 / (1 + number<F>(0.5 - 2 / (3 * pi)) * roughness_); }
  /// The share of light from one direction that facets scatter once, for rho = 1.
  F albedo(F cosine) const {
    const F g = for_each_lane<F>([&](int i) { return grazing(double(lane_of(cosine, i))); });
    return a() * (1 + roughness_ * g);
  }
  F mean_albedo() const { return a() * (1 + number<F>(2. / 3 - 28 / (15 * pi)) * roughness_); }

 private:
  F roughness_;

  /// The mean of s / t for diffuse light.
  static double grazing(double cosine) {
    const double c = std::clamp(cosine, 1e-4, 1.0), s = std::sqrt(1 - c * c), theta = std::acos(c);
    return inv_pi * (s * (theta - s * c) + 2. / 3 * (s / c * (1 - s * s * s) - s));
  }
};

/// The colour rho_ms of light that meets two facets or more.
inline Spectrum multiply_scattered(const Spectrum& rho, double mean_albedo) {
  return rho * rho * mean_albedo / (Spectrum(1) - rho * (1 - mean_albedo));
}

}  // namespace mlt
