// Functions of several models: the one-sided horizon test, and a choice between two lobes that can
// be inverted.
#pragma once

#include "math/frame.h"
#include "math/number.h"

#include <glm/common.hpp>

#include <algorithm>

namespace mlt {

/// Whether both directions are above a one-sided surface.
inline bool above(const Vec3& a, const Vec3& b) { return a.z > 0 && b.z > 0; }

/// The one of w and -w that is above the surface.
inline Vec3 upwards(const Vec3& w) { return w.z < 0 ? -w : w; }

inline Vec2 direction_part(const Vec3& u) { return {u.y, u.z}; }

// A first lobe that is taken where u.x < p, else a second: v in [0, 1) as the u.x of one of them.

inline double u_of_first(double p, double v) { return v * p; }
inline double u_of_second(double p, double v) { return std::min(p + v * (1 - p), 1 - 0x1p-53); }

/// Chooses which of two lobes has sampled a direction, if v is uniform; `rest` is v, rescaled.
struct LobeGuess {
  bool first;
  double rest;
};
inline LobeGuess guess_lobe(double first, double second, double v) {
  const double share = first / (first + second);
  if (v < share) return {true, std::min(v / share, 1 - 0x1p-53)};
  return {false, std::min((v - share) / (1 - share), 1 - 0x1p-53)};
}

/// A u in [0, 1)^3 from its lobe part and direction part: inverses may round up to 1.
inline Vec3 u_of(double lobe, const Vec2& direction) {
  return {lobe, glm::clamp(direction, 0.0, 1 - 0x1p-53)};
}

/// a / (a + b), the probability of the first lobe; 0 where both weights are 0.
template <class F>
F first_share(F a, F b) {
  return select(a > 0, a / (a + b), F(0));
}

}  // namespace mlt
