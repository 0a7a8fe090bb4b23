// A point of primary sample space (Kelemen, Szirmay-Kalos, Antal & Csonka 2002, "A simple and
// robust mutation strategy for the Metropolis light transport algorithm"): the uniform numbers that
// paths are made from.
//
// They form streams, so that a walk from the camera that has become longer does not shift the
// numbers of the walk from the light. A step moves all numbers, also those that the current paths
// do not use, but each lazily, when it is read (Kelemen et al. 2002, sec. 4.3): it stores the step
// up to which it has moved, and then catches up with those that it has missed.
#pragma once

#include "base/bytes.h"
#include "base/error.h"
#include "path/samplers.h"
#include "primary/small_step.h"

#include <array>
#include <vector>

namespace mlt {

class PrimaryNumbers {
 public:
  /// The state after one more step: all numbers are drawn afresh, or each moves a little.
  void step(bool large) {
    ++now_;
    if (large) last_large_ = now_;
  }

  /// Clears all numbers, but keeps the buffers.
  void clear() {
    for (auto& numbers : streams_) numbers.clear();
    now_ = last_large_ = 0;
  }

  /// Number i of a stream; i is at most their number.
  double get(Stream stream, size_t i, const SmallStep& small_step, Rng& rng) {
    std::vector<Number>& numbers = streams_[static_cast<size_t>(stream)];
    if (i == numbers.size()) numbers.push_back({rng.next(), now_});
    Number& number = numbers[i];
    if (number.step < last_large_) number = {rng.next(), last_large_};
    if (number.step < now_) number = {small_step(number.value, missed(number), rng), now_};
    return number.value;
  }

  /// Sets number i; i is at most their number.
  void set(Stream stream, size_t i, double value) {
    std::vector<Number>& numbers = streams_[static_cast<size_t>(stream)];
    if (i == numbers.size()) numbers.emplace_back();
    numbers[i] = {value, now_};
  }

  void save(ByteWriter& bytes) const {
    bytes.write(now_);
    bytes.write(last_large_);
    for (const auto& numbers : streams_) bytes.write(numbers);
  }
  void load(ByteReader& bytes) {
    now_ = bytes.read<uint64_t>();
    last_large_ = bytes.read<uint64_t>();
    for (auto& numbers : streams_) {
      bytes.read(numbers);
      for (const Number& number : numbers)
        if (!(number.value >= 0 && number.value < 1 && number.step <= now_))
          throw RenderError("the saved state has a number outside of [0, 1)");
    }
  }

 private:
  struct Number {
    double value = 0;
    uint64_t step = 0;  ///< The step up to which it has moved.
  };
  /// After this number of small steps a number is uniform to 1e-24, whatever it was.
  static constexpr uint64_t most = 1 << 16;
  uint64_t missed(const Number& number) const { return std::min(now_ - number.step, most); }

  std::array<std::vector<Number>, stream_count> streams_;
  uint64_t now_ = 0, last_large_ = 0;
};

/// Reads the numbers, one stream after the other.
class PrimarySampler {
 public:
  PrimarySampler(PrimaryNumbers& numbers, const SmallStep& small_step, Rng& rng)
      : numbers_(&numbers), small_step_(small_step), rng_(&rng) {}

  void begin(Stream stream) { stream_ = stream; }
  double next() {
    return numbers_->get(stream_, used_[static_cast<size_t>(stream_)]++, small_step_, *rng_);
  }
  Vec2 next2() {
    const double x = next();
    return {x, next()};
  }

 private:
  PrimaryNumbers* numbers_;
  SmallStep small_step_;
  Rng* rng_;
  Stream stream_ = Stream::camera;
  std::array<size_t, stream_count> used_{};
};

}  // namespace mlt
