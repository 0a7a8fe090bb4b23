#include "wave/wave_numbers.h"

#include "base/whole_vectors.h"

namespace mlt {
namespace {

constexpr int vector = 8;

}  // namespace

void WaveNumbers::read(const Place& at, int begin, int count, double* x) const {
  if (!at.stratified_single()) return read_words(at.words, begin, count, x);
  for (int first = 0; first < count; first += vector) {
    uint64_t seeds[vector];
    for (int i = 0; i < vector; ++i)
      seeds[i] = PixelSampler::seed_of_single(stream_[begin + first + i], at);
    scrambled_radical_inverse<vector>(&index_[begin + first], seeds, x + first);
  }
  if (!PixelSampler::is_time(at)) return;
  for (int i = 0; i < count; ++i) x[i] = exposure_.time(x[i]);
}

void WaveNumbers::read2(const Place& at, int begin, int count, double* x, double* y) const {
  if (!at.stratified_pair()) {
    read_words(at.words, begin, count, x);
    read_words(at.words + 1, begin, count, y);
    return;
  }
  const uint64_t pair = at.pairs;
  for (int first = 0; first < count; first += vector) {
    uint64_t seeds[vector];
    for (int i = 0; i < vector; ++i) seeds[i] = stream_[begin + first + i] + pair;
    scrambled_sobol<vector>(&index_[begin + first], seeds, x + first, y + first);
  }
}

void WaveNumbers::read_words(uint64_t n, int begin, int count, double* x) const {
  const int end = whole_vectors(count);
  for (int i = 0; i < end; ++i) x[i] = word(begin + i, n);
}

}  // namespace mlt
