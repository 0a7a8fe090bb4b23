// Sources of uniform numbers for a walk. All have next(), next2(), and begin(stream), which says what
// the numbers that follow are for; walks are templates over them.
#pragma once

#include "base/rng.h"
#include "math/low_discrepancy.h"
#include "math/vec.h"

#include <array>

namespace mlt {

/// What numbers are for: the walk from the camera, that from the light, and the choice of lights as
/// seen from the vertices of the former.
enum class Stream { camera, light, direct };
inline constexpr size_t stream_count = 3;

/// Independent random numbers.
class RandomSampler {
 public:
  explicit RandomSampler(Rng& rng) : rng_(&rng) {}
  void begin(Stream) {}
  double next() { return rng_->next(); }
  Vec2 next2() {
    const double x = rng_->next();
    return {x, rng_->next()};
  }

 private:
  Rng* rng_;
};

/// The samples of one pixel: the first pairs of numbers are stratified over the pixel's samples,
/// the others are independent.
class PixelSampler {
 public:
  /// `stream` names the sequence (seed, group and pixel), `index` the sample in it.
  PixelSampler(uint64_t stream, uint32_t index)
      : stratified_(scrambled_sobol<stratified_pairs>(index, stream)),
        rng_(stream, Purpose::pixel, index) {}

  void begin(Stream) {}
  double next() { return rng_.next(); }
  Vec2 next2() {
    if (pair_ < stratified_pairs) return stratified_[pair_++];
    const double x = rng_.next();
    return {x, rng_.next()};
  }

 private:
  /// Image position, lens, and the light and direction of the first vertices.
  static constexpr size_t stratified_pairs = 6;
  std::array<Vec2, stratified_pairs> stratified_;
  size_t pair_ = 0;
  Rng rng_;
};

}  // namespace mlt
