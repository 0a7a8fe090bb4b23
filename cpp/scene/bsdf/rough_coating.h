// The reflectance and transmittance of a rough dielectric coating for one scattering event,
// tabulated by the cosine of the direction.
#pragma once

#include "math/microfacet.h"

#include <array>

namespace mlt {

/// The fractions of light from one direction that a rough interface reflects and transmits, when
/// light that is masked after one scattering is lost: the means over the normals m that are visible
/// from this direction,
///   R = mean of F G1(reflected, m),  T = mean of (1 - F) G1(refracted, m)
/// (the albedos of Walter et al. 2007, eqs. 20 and 21, by eq. 41).
template <class F>
struct RoughFresnelOf {
  F reflectance, transmittance;
};
using RoughFresnel = RoughFresnelOf<double>;

class RoughCoating {
 public:
  RoughCoating(MicrofacetType type, double alpha, double eta);

  /// The fractions for a direction with this cosine from outside, 0 <= cos_i <= 1.
  template <class F>
  RoughFresnelOf<F> at(F cos_i) const {
    const F x = max(F(0), min(cos_i, F(1))) * number<F>(size - 1);
    const F i = min(floor(x), number<F>(size - 2)), t = x - i;
    const auto interpolated = [&](double RoughFresnel::* part) {
      const auto node = [&](int next) {
        return for_each_lane<F>(
            [&](int lane) { return table_[static_cast<int>(lane_of(i, lane)) + next].*part; });
      };
      const F a = node(0), b = node(1);
      return a + t * (b - a);
    };
    return {interpolated(&RoughFresnel::reflectance), interpolated(&RoughFresnel::transmittance)};
  }

  /// The mean reflectance for diffuse light from inside.
  double internal_reflectance() const { return internal_reflectance_; }
  /// The mean transmittance for diffuse light from outside.
  double mean_transmittance() const;

 private:
  /// Mitsuba 3 has the same nodes and interpolation: the model agrees with it at every angle.
  static constexpr size_t size = 64;

  std::array<RoughFresnel, size> table_;
  double internal_reflectance_;
};

}  // namespace mlt
