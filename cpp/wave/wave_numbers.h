// The random numbers of many samples side by side, equal to those of the PixelSampler of each.
#pragma once

#include "math/lanes.h"
#include "path/samplers.h"

namespace mlt {

class WaveNumbers {
 public:
  void clear() {
    count_ = 0;
    next_ = {};
  }
  /// Adds a sample; all are of one exposure.
  void add(uint64_t stream, const SampleIndex& index) {
    stream_[count_] = stream;
    key_[count_] = PixelSampler::key_of(stream, index.place);
    index_[count_++] = index.place;
    exposure_ = index;
  }
  int count() const { return count_; }

  /// The place of a number, or of a pair, among those of each sample.
  using Place = PixelSampler::Position;
  /// The place of the next numbers, for all samples: a sampler of places.
  Place& places() { return next_; }
  /// To be called before the numbers of a vertex, from this place on, are read, or only the one of
  /// the leg to it.
  void begin_vertex(const Place&, int /*begin*/, int /*count*/, bool /*leg_alone*/) {}

  /// Reads the numbers at a place of the `count` samples from the begin-th on.
  void read(const Place& at, int begin, int count, double* x) const;
  void read2(const Place& at, int begin, int count, double* x, double* y) const;
  /// The number at a place of the i-th sample.
  double read(const Place& at, int i) const {
    if (!at.stratified_single()) return word(i, at.words);
    const SampleIndex index(index_[i], exposure_.exposure, exposure_.exposures);
    return PixelSampler::single(stream_[i], index, at);
  }

  /// Moves the sample at `from` to the i-th place.
  void move(int i, int from) {
    stream_[i] = stream_[from];
    key_[i] = key_[from];
    index_[i] = index_[from];
  }

 private:
  void read_words(uint64_t n, int begin, int count, double* x) const;
  double word(int i, uint64_t n) const { return unit_interval(nth_bits(key_[i], n)); }

  int count_ = 0;
  Place next_;
  Wave<uint64_t> stream_, key_;
  Wave<uint32_t> index_;
  SampleIndex exposure_ = 0;  ///< One of them, for the exposure of all.
};

}  // namespace mlt
