// A point of primary sample space (Kelemen et al. 2002) for walks from the camera: the numbers that
// a walk has taken, in their order, and no others. A longer walk after a small step draws the
// additional numbers afresh, a shorter one drops the unused ones: the density of both is 1, so that
// the step is symmetric.
#pragma once

#include "base/bytes.h"
#include "base/error.h"
#include "path/samplers.h"
#include "wave/number_rows.h"

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

  /// The row of numbers that begins at `first`, or nullptr; it may reach beyond the last number.
  const double* row(size_t first) const { return first < size_ ? &values_[first] : nullptr; }
  /// Replaces all numbers from `first` on by the first `count` ones of this row.
  void end_with(const double* row, size_t first, size_t count) {
    make_room(size_ = first + count);
    std::memcpy(&values_[first], row, NumberRows::row * sizeof(double));
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
  void make_room(size_t count) {
    const size_t wanted = count + NumberRows::row;
    if (values_.size() < wanted) values_.resize(std::max(wanted, 2 * values_.size()));
  }

  std::vector<double> values_;  ///< With room for another row.
  size_t size_ = 0;
};

/// Draws the numbers of a walk, and records them.
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
