// A point of primary sample space (Kelemen, Szirmay-Kalos, Antal & Csonka 2002, "A simple and
// robust mutation strategy for the Metropolis light transport algorithm"): the uniform numbers that
// the current paths are made from, and no others. After a small step longer walks draw the
// additional numbers afresh, shorter ones drop the unused ones: the density of both is 1, so that
// the step is symmetric.
//
// The numbers form streams, so that a walk from the camera that has become longer does not shift
// the numbers of the walk from the light.
#pragma once

#include "base/bytes.h"
#include "base/error.h"
#include "path/samplers.h"
#include "primary/small_step.h"

#include <algorithm>
#include <array>
#include <vector>

namespace mlt {

class PrimarySamples {
 public:
  /// The numbers of a stream, in the order in which they are drawn.
  std::vector<double>& operator[](Stream stream) { return streams_[static_cast<size_t>(stream)]; }
  const std::vector<double>& operator[](Stream stream) const {
    return streams_[static_cast<size_t>(stream)];
  }
  /// Removes all numbers, but keeps the buffers.
  void clear() {
    for (auto& numbers : streams_) numbers.clear();
  }

  /// Adds the numbers that x has beyond these.
  void add_rest(const PrimarySamples& x) {
    for (size_t i = 0; i < stream_count; ++i) {
      const size_t size = std::min(streams_[i].size(), x.streams_[i].size());
      streams_[i].insert(streams_[i].end(), x.streams_[i].begin() + size, x.streams_[i].end());
    }
  }

  void save(ByteWriter& bytes) const {
    for (const auto& numbers : streams_) bytes.write(numbers);
  }
  void load(ByteReader& bytes) {
    for (auto& numbers : streams_) {
      bytes.read(numbers);
      for (const double number : numbers)
        if (!(number >= 0 && number < 1))
          throw RenderError("the saved state has a number outside of [0, 1)");
    }
  }

 private:
  std::array<std::vector<double>, stream_count> streams_;
};

/// Draws the numbers of a sample, and records them in y: near those of x, and afresh where x has
/// none or is nullptr.
class PrimarySampler {
 public:
  PrimarySampler(const PrimarySamples* x, PrimarySamples& y, const SmallStep& small_step, Rng& rng)
      : x_(x), y_(&y), small_step_(small_step), rng_(&rng) {
    y.clear();
  }

  void begin(Stream stream) { stream_ = stream; }
  double next() {
    std::vector<double>& y = (*y_)[stream_];
    const bool known = x_ && y.size() < (*x_)[stream_].size();
    y.push_back(known ? small_step_((*x_)[stream_][y.size()], *rng_) : rng_->next());
    return y.back();
  }
  Vec2 next2() {
    const double x = next();
    return {x, next()};
  }

 private:
  const PrimarySamples* x_;
  PrimarySamples* y_;
  SmallStep small_step_;
  Rng* rng_;
  Stream stream_ = Stream::camera;
};

}  // namespace mlt
