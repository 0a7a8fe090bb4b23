#include "wave/wave_numbers.h"

#include "base/whole_vectors.h"

namespace mlt {

void WaveNumbers::next(int begin, int count, double* x) {
  const int end = whole_vectors(count);
  const uint64_t n = at_.words++;
  for (int i = 0; i < end; ++i) x[i] = word(begin + i, n);
}

void WaveNumbers::next2(int begin, int count, double* x, double* y) {
  if (at_.pairs == at_.last_pair) {
    next(begin, count, x);
    next(begin, count, y);
    return;
  }
  const uint64_t pair = at_.pairs++;
  constexpr int vector = 8;
  for (int first = 0; first < count; first += vector) {
    uint64_t seeds[vector];
    for (int i = 0; i < vector; ++i) seeds[i] = stream_[begin + first + i] + pair;
    scrambled_sobol<vector>(&index_[begin + first], seeds, x + first, y + first);
  }
}

void WaveNumbers::skip2() {
  if (at_.pairs == at_.last_pair)
    at_.words += 2;
  else
    ++at_.pairs;
}

}  // namespace mlt
