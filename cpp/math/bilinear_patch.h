// A density over the unit square that is proportional to the bilinear interpolation of four values
// (M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th ed., A.5.5).
#pragma once

#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace mlt {

/// The density (1 - x) a + x b over [0,1], times 2 / (a + b).
struct LinearDensity {
  double a, b;

  /// The root of u (a + b) = x (2 a + x (b - a)), in a form without cancellation.
  double sample(double u) const {
    const double divisor = a + std::sqrt((1 - u) * a * a + u * b * b);
    return divisor > 0 ? std::min(u * (a + b) / divisor, 1 - 0x1p-53) : u;
  }
  double invert(double x) const { return x * (2 * a + x * (b - a)) / (a + b); }
};

/// The values at (0, 0), (1, 0), (0, 1) and (1, 1); not negative, and not all zero.
struct BilinearPatch {
  double v00, v10, v01, v11;

  Vec2 sample(const Vec2& u) const {
    const double y = over_y().sample(u.y);
    return {row(y).sample(u.x), y};
  }
  double density(const Vec2& p) const {
    const LinearDensity row = this->row(p.y);
    return ((1 - p.x) * row.a + p.x * row.b) * 4 / (v00 + v10 + v01 + v11);
  }
  /// The u that sample() maps to p.
  Vec2 invert(const Vec2& p) const { return {row(p.y).invert(p.x), over_y().invert(p.y)}; }

 private:
  LinearDensity over_y() const { return {v00 + v10, v01 + v11}; }
  LinearDensity row(double y) const { return {(1 - y) * v00 + y * v01, (1 - y) * v10 + y * v11}; }
};

}  // namespace mlt
