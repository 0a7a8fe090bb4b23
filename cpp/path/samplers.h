// Sources of uniform numbers for a walk. All have next() and next2(); walks are templates over
// them.
#pragma once

#include "base/rng.h"
#include "math/low_discrepancy.h"
#include "math/vec.h"

#include <vector>

namespace mlt {

/// Independent random numbers.
class RandomSampler {
 public:
  explicit RandomSampler(Rng& rng) : rng_(&rng) {}
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

/// A point of primary sample space (Kelemen et al. 2002): numbers that are given, continued by
/// fresh ones where the walk asks for more.
class PrimarySampler {
 public:
  PrimarySampler(std::vector<double>& numbers, Rng& rng) : numbers_(&numbers), rng_(&rng) {}
  double next() {
    if (used_ == numbers_->size()) numbers_->push_back(rng_->next());
    return (*numbers_)[used_++];
  }
  Vec2 next2() {
    const double x = next();
    return {x, next()};
  }
  size_t used() const { return used_; }

 private:
  std::vector<double>* numbers_;
  Rng* rng_;
  size_t used_ = 0;
};

}  // namespace mlt
