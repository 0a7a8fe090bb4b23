// The weights of a narrow filter at the consecutive pixels of a row that it covers, from a table of
// such rows. Where the filter's knots fall on the same places of every pixel, they lie on one
// straight line between two rows of the table.
#pragma once

#include "image/filter.h"

#include <array>

namespace mlt {

template <class Real>
class FilterRows {
 public:
  static constexpr int most_pixels = 8;
  struct Weights {
    int first;                         ///< First pixel.
    std::array<Real, most_pixels> at;  ///< Weights from `first` on; 0 beyond the last.
  };

  explicit FilterRows(const Filter& filter) : radius_(filter.radius()) {
    const int phases = filter.knots_per_pixel();
    const double pixels = 2 * radius_;
    if (filter.is_box() || phases == 0 || pixels > most_pixels || pixels != std::floor(pixels))
      return;
    pixels_ = static_cast<int>(pixels);
    phases_ = phases;
    rows_.resize(phases + 1);
    for (int j = 0; j <= phases; ++j)
      for (int k = 0; k < pixels_; ++k)
        rows_[j][k] = static_cast<Real>(filter.knot(std::abs(j + phases * (k - 0.5 * pixels_))));
  }

  /// How many pixels of a row the filter covers; 0: there is no table for this filter.
  int pixels() const { return pixels_; }

  /// The weights of a sample at this place of the row.
  Weights weights(double at) const {
    const double low = at - radius_ - 0.5, floor = std::floor(low);
    const double t = (1 - (low - floor)) * phases_;
    const int j = std::min(static_cast<int>(t), phases_ - 1);
    const auto share = static_cast<Real>(t - j);
    Weights weights;
    weights.first = static_cast<int>(floor) + 1;
    const Real *a = rows_[j].data(), *b = rows_[j + 1].data();
    for (int k = 0; k < most_pixels; ++k) weights.at[k] = a[k] + share * (b[k] - a[k]);
    return weights;
  }

 private:
  double radius_;
  int pixels_ = 0, phases_ = 0;
  std::vector<std::array<Real, most_pixels>> rows_;  ///< Padded with zeros.
};

}  // namespace mlt
