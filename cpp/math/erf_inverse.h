// The inverse of the error function in double precision: the polynomial approximation of Giles
// 2010, "Approximating the erfinv function" (single precision), refined by Halley's method, which
// triples the number of correct digits in each step; only the far tails need more than one.
#pragma once

#include "math/polynomial.h"
#include "math/vec.h"

namespace mlt {

constexpr double two_over_sqrt_pi = 1.12837916709551257390;

/// erf_inverse to about 7 digits.
inline double erf_inverse_estimate(double y) {
  const double w = -std::log((1 - y) * (1 + y));
  if (w < 5)
    return y * polynomial(w - 2.5,
                          {2.81022636e-08, 3.43273939e-07, -3.5233877e-06, -4.39150654e-06,
                           0.00021858087, -0.00125372503, -0.00417768164, 0.246640727, 1.50140941});
  return y * polynomial(std::sqrt(w) - 3,
                        {-0.000200214257, 0.000100950558, 0.00134934322, -0.00367342844,
                         0.00573950773, -0.0076224613, 0.00943887047, 1.00167406, 2.83297682});
}

/// x with erf(x) = y, for |y| < 1.
inline double erf_inverse(double y) {
  double x = erf_inverse_estimate(y);
  for (int steps = std::abs(y) < 1 - 1e-6 ? 1 : 3; steps > 0; --steps) {
    const double newton = (std::erf(x) - y) / (two_over_sqrt_pi * std::exp(-x * x));
    x -= newton / (1 + x * newton);
  }
  return x;
}

}  // namespace mlt
