// Polynomials by Horner's rule; the loop unrolls at compile time.
#pragma once

#include <cstddef>

namespace mlt {

/// coefficients[0] x^(N-1) + ... + coefficients[N-1].
template <class F, size_t N>
inline F polynomial(F x, const F (&coefficients)[N]) {
  F sum = coefficients[0];
  for (size_t i = 1; i < N; ++i) sum = sum * x + coefficients[i];
  return sum;
}

}  // namespace mlt
