// A point of primary sample space (Kelemen et al. 2002) for walks from the camera: the numbers that a
// walk has taken, in their order, and no others. A longer walk after a small step draws those beyond
// afresh, a shorter one forgets what it leaves out: the density of both is 1, so that the step is
// symmetric.
#pragma once

#include "base/bytes.h"
#include "base/error.h"
#include "path/samplers.h"
#include "primary/small_step.h"

#include <algorithm>
#include <vector>

namespace mlt {

class WalkNumbers {
 public:
  size_t size() const { return size_; }
  const double* data() const { return values_.data(); }
  void clear() { size_ = 0; }
  void push_back(double value) {
    make_room(size_ + 1);
    values_[size_++] = value;
  }

  /// Draws `count` numbers from `first` on, by the random numbers of `key`: afresh, or near those of
  /// `from`, which has all of them or none.
  void draw(size_t first, size_t count, uint64_t key, const WalkNumbers* from,
            const SmallStep& step) {
    make_room(size_ = first + count);
    double* y = &values_[first];
    if (!from || first >= from->size_)
      for (size_t i = 0; i < row; ++i) y[i] = unit_interval(nth_bits(key, first + i));
    else
      move(&from->values_[first], first, key, step, y);
  }

  void save(ByteWriter& bytes) const {
    bytes.write(std::vector<double>(values_.begin(), values_.begin() + size_));
  }
  void load(ByteReader& bytes) {
    bytes.read(values_);
    size_ = values_.size();
    for (const double value : values_)
      if (!(value >= 0 && value < 1))
        throw RenderError("the saved state has a number outside of [0, 1)");
    make_room(size_);
  }

 private:
  static void move(const double* x, size_t first, uint64_t key, const SmallStep& step, double* y) {
    if (step.shape == SmallStep::Shape::gaussian) {
      for (size_t i = 0; i < row; ++i)
        y[i] = step.gaussian(x[i], 1, unit_interval(nth_bits(key, 2 * (first + i))),
                             unit_interval(nth_bits(key, 2 * (first + i) + 1)));
      return;
    }
    for (size_t i = 0; i < row; ++i)
      y[i] = step.kelemen(x[i], unit_interval(nth_bits(key, first + i)));
  }
  void make_room(size_t count) {
    if (values_.size() < count + row) values_.resize(std::max(count + row, 2 * values_.size()));
  }

  /// So many are drawn at once, in whole vectors; what is more than was asked for is overwritten.
  static constexpr size_t row = 8;

  std::vector<double> values_;  ///< And room for another row.
  size_t size_ = 0;
};

/// Draws the numbers of a walk, and keeps them.
class WalkNumbersSampler {
 public:
  WalkNumbersSampler(WalkNumbers& numbers, Rng& rng) : numbers_(&numbers), rng_(&rng) {
    numbers.clear();
  }
  void begin(Stream) {}
  double next() {
    const double u = rng_->next();
    numbers_->push_back(u);
    return u;
  }
  Vec2 next2() {
    const double x = next();
    return {x, next()};
  }

 private:
  WalkNumbers* numbers_;
  Rng* rng_;
};

}  // namespace mlt
