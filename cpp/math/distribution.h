// Tabulated distributions: weights over indices, and a piecewise-constant density over the unit
// square for environment maps (Pharr et al., PBRT 3rd ed., sec. 13.3 and 13.6.7). Samples and their
// probabilities come from the same cumulative table, so rounding in the table cannot bias an
// estimate.
#pragma once

#include "base/shared_array.h"
#include "math/sorted_rows.h"
#include "math/vec.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mlt {

/// Indices 0 .. n-1 with probabilities proportional to weights.
class Discrete {
 public:
  struct Sample {
    size_t index;
    double remainder;  // uniform in [0, 1), independent of the index: u can be used again
  };

  Discrete() = default;
  /// Throws UsageError if there are no weights, one is negative or not finite, or all are zero.
  explicit Discrete(const std::vector<double>& weights);

  bool empty() const { return cdf_.empty(); }
  size_t size() const { return cdf_.empty() ? 0 : cdf_.size() - 1; }
  /// The sum of the weights.
  double total() const { return total_; }

  size_t sample(double u) const {
    if (const size_t n = size(); n <= few) {  // Without branches that would be guessed wrong.
      size_t index = 0;
      for (size_t i = 1; i < n; ++i) index += u >= cdf_[i];
      return index;
    }
    return starts_.last_up_to(0, u);
  }
  double pdf(size_t index) const { return cdf_[index + 1] - cdf_[index]; }
  /// Where the u of an index begin.
  double begin(size_t index) const { return cdf_[index]; }

  Sample sample_reuse(double u) const {
    const size_t i = sample(u);
    return {i, std::min((u - cdf_[i]) / (cdf_[i + 1] - cdf_[i]), 1 - 0x1p-53)};
  }
  /// The u that sample_reuse maps to (index, remainder).
  double invert(size_t index, double remainder = 0.5) const {
    return cdf_[index] + remainder * (cdf_[index + 1] - cdf_[index]);
  }

 private:
  static constexpr size_t few = 8;
  SharedArray<double> cdf_;    // n + 1 values from exactly 0 to exactly 1
  SortedRows<double> starts_;  // the first n of cdf_, if they are not few
  double total_ = 0;
};

/// A density on [0,1]^2 that is constant in each cell of a `width` x `height` grid (x runs
/// fastest). Each row's cumulative table holds 32-bit integers: 4 bytes per cell, as floats would
/// take, but with a resolution of 2^-32 everywhere, and every cell of positive weight can be
/// sampled.
class Piecewise2D {
 public:
  Piecewise2D() = default;
  /// Throws UsageError for a size mismatch, a negative or non-finite weight, or all zero.
  Piecewise2D(const std::vector<float>& weights, size_t width, size_t height);

  size_t width() const { return width_; }
  size_t height() const { return height_; }
  /// The mean of the weights: the integral of the tabulated function over the unit square.
  double integral() const { return integral_; }

  struct Sample {
    Vec2 at;
    double pdf;
  };
  Sample sample(const Vec2& u) const;
  static constexpr int most_together = 64;
  /// Cells sampled by many numbers, the places in them, in [0, 1), and their probabilities.
  struct Cells {
    size_t row[most_together], column[most_together];
    alignas(64) double y[most_together], x[most_together], probability[most_together];
  };
  /// Samples by many numbers, at most `most_together`; much faster where the table is large.
  void sample_cells(const Vec2* u, int count, Cells& cells) const;
  double probability(size_t row, size_t column) const;
  double pdf(const Vec2& p) const;
  /// The u that sample maps to p; meaningful where pdf(p) > 0.
  Vec2 invert(const Vec2& p) const;

 private:
  struct Place {
    size_t row, column;
    double y, x;  // place within the cell, in [0, 1]
  };
  Place locate(const Vec2& p) const;
  double cells() const { return static_cast<double>(width_) * static_cast<double>(height_); }

  static constexpr uint32_t full = 0xffffffffu;
  size_t width_ = 0, height_ = 0;
  Discrete rows_;
  SortedRows<uint32_t> starts_;  // for each row: where each column's share of [0, full) begins
  double integral_ = 0;
};

}  // namespace mlt
