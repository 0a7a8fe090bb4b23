// Reconstruction filters: the weight with which a sample at raster position p counts in a pixel.
// A filter is separable, h(x, y) = f(x) f(y), and f integrates to exactly 1 over its support, so
// that the film divides by expected weights only:
//
//   pixel (i, j) = E[ contribution * f(i + 1/2 - p_x) f(j + 1/2 - p_y) ]
//
// The integral is normalised, not the sum over the pixels that one sample touches: a
// filter whose shifts do not add up to 1 (gaussian, lanczos) is still unbiased this way.
//
// f is stored as a table of its right half and interpolated linearly. What is normalised is the
// interpolant itself, whose integral is a trapezoidal sum. The knots fall on the integers, so a
// partition of unity stays one.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace mlt {

class Filter {
 public:
  /// `shape` is the right half of f, which need not be normalised. UsageError if it has no positive
  /// weight.
  Filter(const std::string& name, double radius, const std::function<double(double)>& shape);

  const std::string& name() const { return name_; }
  double radius() const { return radius_; }

  /// Whether a sample is recorded in exactly one pixel, the one it lies in, with weight 1.
  bool is_box() const { return box_; }

  /// f(x). The support is half open, -radius < x <= radius, so that a sample on the border between
  /// two pixels falls with the box filter into pixel floor(p).
  double eval(double x) const {
    if (!(x > -radius_ && x <= radius_)) return 0;
    const double t = std::abs(x) * scale_;
    const int i = std::min(static_cast<int>(t), intervals - 1);
    const double* low = table_.data() + i;
    return low[0] + (t - i) * (low[1] - low[0]);
  }
  /// The number of knots per pixel between which f is linear, the integers among them; 0 if they
  /// differ from pixel to pixel.
  int knots_per_pixel() const {
    return scale_ == std::floor(scale_) ? static_cast<int>(scale_) : 0;
  }
  /// f at the i-th knot from the middle.
  double knot(double i) const { return table_[static_cast<size_t>(i)]; }
  /// The maximum of |f(x)|.
  double largest() const { return largest_; }
  /// Whether f is negative somewhere, so that pixels may be negative.
  bool has_negative_lobes() const;

 private:
  static constexpr int intervals = 768;  // a multiple of 1, 2, 3, 4, 6, 8 lobes

  std::string name_;
  double radius_, scale_;
  double largest_ = 0;
  bool box_;
  std::vector<double> table_;
};

// Names, parameters and defaults are Mitsuba 3's; a parameter out of range is a UsageError.
Filter box_filter(double radius = 0.5);
Filter tent_filter(double radius = 1);
/// A Gaussian cut at 4 standard deviations and lowered so that it is 0 there.
Filter gaussian_filter(double stddev = 0.5);
/// Mitchell & Netravali 1988, eq. 8, radius 2.
Filter mitchell_filter(double b = 1.0 / 3, double c = 1.0 / 3);
/// The Mitchell filter with B = 0, C = 1/2, which interpolates.
Filter catmullrom_filter();
/// The Lanczos filter: sinc(x) windowed by sinc(x / lobes).
Filter lanczos_filter(int lobes = 3);

}  // namespace mlt
