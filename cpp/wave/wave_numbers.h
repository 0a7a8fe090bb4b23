// The random numbers of many samples side by side, equal to those of the PixelSampler of each.
#pragma once

#include "path/samplers.h"
#include "wave/lanes.h"

namespace mlt {

class WaveNumbers {
 public:
  void clear() {
    count_ = 0;
    at_ = {};
  }
  void add(uint64_t stream, uint32_t index) {
    stream_[count_] = stream;
    key_[count_] = PixelSampler::key_of(stream, index);
    index_[count_++] = index;
  }
  int count() const { return count_; }
  /// Sets the position of the next numbers, for all samples.
  void set_position(const PixelSampler::Position& at) { at_ = at; }

  const PixelSampler::Position& position() const { return at_; }
  /// To be called before the numbers of a vertex are taken.
  void begin_vertex(int /*begin*/, int /*count*/) {}

  /// The next numbers of the `count` samples from the begin-th on; advances the position, as a
  /// sampler does.
  void next(int begin, int count, double* x);
  void next2(int begin, int count, double* x, double* y);
  void skip(uint32_t numbers) { at_.words += numbers; }
  void skip2();
  /// The number that next() would give the i-th sample, `ahead` calls later.
  double peek(int i, uint32_t ahead) const { return word(i, at_.words + ahead); }

  /// Moves the sample at `from` to the i-th place.
  void move(int i, int from) {
    stream_[i] = stream_[from];
    key_[i] = key_[from];
    index_[i] = index_[from];
  }

 private:
  double word(int i, uint64_t n) const { return unit_interval(nth_bits(key_[i], n)); }

  int count_ = 0;
  PixelSampler::Position at_;
  Wave<uint64_t> stream_, key_;
  Wave<uint32_t> index_;
};

}  // namespace mlt
