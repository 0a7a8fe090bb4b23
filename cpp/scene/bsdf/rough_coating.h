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
struct RoughFresnel {
  double reflectance, transmittance;
};

class RoughCoating {
 public:
  RoughCoating(MicrofacetType type, double alpha, double eta);

  /// The fractions for a direction with this cosine from outside, 0 <= cos_i <= 1.
  RoughFresnel at(double cos_i) const {
    const double x = std::min(cos_i, 1.0) * (size - 1);
    const auto i = std::min(static_cast<size_t>(x), size - 2);
    const double t = x - static_cast<double>(i);
    const RoughFresnel &a = table_[i], &b = table_[i + 1];
    return {a.reflectance + t * (b.reflectance - a.reflectance),
            a.transmittance + t * (b.transmittance - a.transmittance)};
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
