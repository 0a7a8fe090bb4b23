// The light of black bodies.
#pragma once

#include "math/vec.h"

#include <cmath>

namespace mlt {

/// Wien's displacement law: the radiance per wavelength has its maximum at this over T, in nm K
/// (CODATA 2018).
constexpr double wien = 2.897771955e6;

/// Planck's law in W / (m^2 sr nm), for a wavelength in nm:
/// B(lambda, T) = 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1).
inline double planck_radiance(double wavelength, double kelvin) {
  // Exact in the SI of 2019, in units of m, kg, s and K.
  constexpr double light_speed = 299792458, planck = 6.62607015e-34, boltzmann = 1.380649e-23;
  constexpr double metres_per_nm = 1e-9;
  const double w = wavelength * metres_per_nm;
  const double exponent = planck * light_speed / (w * boltzmann * kelvin);
  return 2 * planck * sqr(light_speed) / (sqr(sqr(w)) * w * std::expm1(exponent)) * metres_per_nm;
}

}  // namespace mlt
