#include "wave/wave_numbers.h"

#include "base/whole_vectors.h"

namespace mlt {

void WaveNumbers::read(const Place& at, int begin, int count, double* x) const {
  const int end = whole_vectors(count);
  const uint64_t n = at.words;
  for (int i = 0; i < end; ++i) x[i] = word(begin + i, n);
}

void WaveNumbers::read2(const Place& at, int begin, int count, double* x, double* y) const {
  if (!at.stratified()) {
    Place words = at;
    read(words.next(), begin, count, x);
    read(words.next(), begin, count, y);
    return;
  }
  const uint64_t pair = at.pairs;
  constexpr int vector = 8;
  for (int first = 0; first < count; first += vector) {
    uint64_t seeds[vector];
    for (int i = 0; i < vector; ++i) seeds[i] = stream_[begin + first + i] + pair;
    scrambled_sobol<vector>(&index_[begin + first], seeds, x + first, y + first);
  }
}

}  // namespace mlt
