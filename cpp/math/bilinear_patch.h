// A density over the unit square that is proportional to the bilinear interpolation of four values
// (M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th ed., A.5.5).
#pragma once

#include "math/number.h"

namespace mlt {

/// The density (1 - x) a + x b over [0,1], times 2 / (a + b).
template <class F>
struct LinearDensity {
  F a, b;

  /// The root of u (a + b) = x (2 a + x (b - a)), in a form without cancellation.
  F sample(const F& u) const {
    const F divisor = a + sqrt((1 - u) * a * a + u * b * b);
    const F x = min(u * (a + b) / divisor, number<F>(1 - 0x1p-53));
    return select(divisor > 0, x, u);
  }
  F invert(const F& x) const { return x * (2 * a + x * (b - a)) / (a + b); }
};

/// The values at (0, 0), (1, 0), (0, 1) and (1, 1); not negative, and not all zero. F is double, or
/// Double4 for four patches.
template <class F>
struct BilinearPatch {
  using Vec2 = Vec2Of<F>;
  F v00, v10, v01, v11;

  Vec2 sample(const Vec2& u) const {
    const F y = over_y().sample(u.y);
    return {row(y).sample(u.x), y};
  }
  F density(const Vec2& p) const {
    const LinearDensity<F> row = this->row(p.y);
    return ((1 - p.x) * row.a + p.x * row.b) * 4 / (v00 + v10 + v01 + v11);
  }
  /// The u that sample() maps to p.
  Vec2 invert(const Vec2& p) const { return {row(p.y).invert(p.x), over_y().invert(p.y)}; }

 private:
  LinearDensity<F> over_y() const { return {v00 + v10, v01 + v11}; }
  LinearDensity<F> row(const F& y) const {
    return {(1 - y) * v00 + y * v01, (1 - y) * v10 + y * v11};
  }
};

}  // namespace mlt
