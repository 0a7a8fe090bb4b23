// e^x without branches or calls, so that loops over it are vectorised.
#pragma once

#include "math/polynomial.h"

#include <cstdint>
#include <cstring>

namespace mlt {

/// e^x for x < 709, to 2 units in the last place; 0 where it is less than the least normal number.
/// With k = round(x / log 2) it is 2^k e^r, |r| <= log(2) / 2, with e^r by its Taylor series
/// (r^14 / 14! < 5e-18).
inline double exponential(double x) {
  constexpr double to_low_bits = 0x1.8p52;  // a sum with it has round(x) in its lowest bits
  constexpr double log2_high = 0x1.62e42feep-1, log2_low = 0x1.a39ef35793c76p-33;
  constexpr double terms[] = {1 / 6227020800.,
                              1 / 479001600.,
                              1 / 39916800.,
                              1 / 3628800.,
                              1 / 362880.,
                              1 / 40320.,
                              1 / 5040.,
                              1 / 720.,
                              1 / 120.,
                              1 / 24.,
                              1 / 6.,
                              1 / 2.,
                              1,
                              1};
  const double in_range = x > -708 ? x : -708;
  const double shifted = in_range * 0x1.71547652b82fep0 + to_low_bits;
  const double k = shifted - to_low_bits;
  const double r = (in_range - k * log2_high) - k * log2_low;
  uint64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits + 1023) << 52;
  double power;
  std::memcpy(&power, &bits, sizeof power);
  return x > -708 ? power * polynomial(r, terms) : 0;
}

}  // namespace mlt
