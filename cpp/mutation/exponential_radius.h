// The step of a perturbation.
#pragma once

#include "math/vec.h"

#include <cmath>

namespace mlt {

/// A distance distributed with density proportional to 1 / R between two radii (Veach 1997, sec.
/// 11.3.3.1): R = R_2 exp(-ln(R_2 / R_1) u).
struct ExponentialRadius {
  double smallest = 0, largest = 0;
  double log_ratio = 0;  ///< ln(R_2 / R_1)

  ExponentialRadius() = default;
  ExponentialRadius(double smallest, double largest)
      : smallest(smallest), largest(largest), log_ratio(std::log(largest / smallest)) {}

  double sample(double u) const { return largest * std::exp(-log_ratio * u); }
  /// Density of an offset of length r to either side on a line.
  double linear_pdf(double r) const {
    if (!(r > smallest && r < largest)) return 0;
    return 1 / (2 * r * log_ratio);
  }
  /// Density of an offset of length r in the plane.
  double planar_pdf(double r) const {
    if (!(r > smallest && r < largest)) return 0;
    return 1 / (2 * pi * r * r * log_ratio);
  }
  /// Density in solid angle of a direction at angle r from another.
  double angular_pdf(double r) const {
    if (!(r > smallest && r < largest)) return 0;
    return 1 / (2 * pi * r * std::sin(r) * log_ratio);
  }
  ExponentialRadius operator*(double s) const {
    ExponentialRadius scaled = *this;
    scaled.smallest *= s;
    scaled.largest *= s;
    return scaled;
  }
};

}  // namespace mlt
