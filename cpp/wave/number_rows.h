// Rows of uniform numbers, drawn afresh or moved by small steps side by side.
#pragma once

#include "math/lanes.h"
#include "primary/small_step.h"

#include <algorithm>
#include <vector>

namespace mlt {

class NumberRows {
 public:
  static constexpr int row = 8, capacity = block_size;

  /// Clears all rows. Those that are added next hold numbers first ... first + row - 1.
  void begin(size_t first) {
    first_ = static_cast<uint32_t>(first);
    moving_ = 0;
    fresh_ = capacity;
  }
  /// Adds a row that is drawn by `key`: near the `count` numbers of x from `first` on, or afresh if
  /// x lacks them or is nullptr. If x lacks some, these are as if they had been drawn. Returns its
  /// index.
  template <size_t count = row>
  int add(uint64_t key, const std::vector<double>* x) {
    const bool known = x && x->size() > first_;
    const int i = known ? moving_++ : --fresh_;
    const auto low = static_cast<uint32_t>(key) + first_, high = static_cast<uint32_t>(key >> 32);
    for (int k = 0; k < row; ++k) {
      low_[row * i + k] = low + k;
      high_[row * i + k] = high;
    }
    if (!known) return i;
    const size_t there = std::min(count, x->size() - first_);
    if (there < count) draw_fresh(row * i, row * (i + 1), lacking_key, x_);
    std::copy_n(&(*x)[first_], there, &x_[row * i]);
    return i;
  }
  int size() const { return moving_ + capacity - fresh_; }
  void draw(const SmallStep& step);
  /// The numbers of row i, after draw().
  const double* operator[](int i) const { return &u_[row * i]; }

 private:
  template <class T>
  using Rows = Lanes<T, row * capacity>;

  // Keys of numbers that are not the result: of a second number, and of one that x lacks.
  static constexpr uint32_t angle_key = ~0u, lacking_key = 0x55555555u;

  void draw_fresh(int begin, int end, uint32_t changed_key, Rows<double>& u) const;

  uint32_t first_ = 0;
  int moving_ = 0, fresh_ = capacity;  ///< Number of moving rows; index of the first fresh one.
  Rows<uint32_t> low_, high_;          ///< Halves of the key of each number.
  Rows<double> x_, u_, angle_;
};

}  // namespace mlt
