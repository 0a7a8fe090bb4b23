// What several models share: the one-sided horizon test, and a choice between two lobes that can be
// inverted.
#pragma once

#include "math/frame.h"

#include <glm/common.hpp>

#include <algorithm>

namespace mlt {

/// Both directions are above a one-sided surface.
inline bool above(const Vec3& a, const Vec3& b) { return a.z > 0 && b.z > 0; }

/// w, or its opposite, whichever is above the surface.
inline Vec3 upwards(const Vec3& w) { return w.z < 0 ? -w : w; }

inline Vec2 direction_part(const Vec3& u) { return {u.y, u.z}; }

// A first lobe that is taken where u.x < p, else a second. The middle of a lobe's interval is the
// u.x that stands for it; the whole interval chooses the same lobe.

inline double u_of_first(double p) { return 0.5 * p; }
inline double u_of_second(double p) { return std::min(0.5 * (1 + p), 1 - 0x1p-53); }

/// A u in [0, 1)^3 from its lobe part and direction part: inverses may round up to 1.
inline Vec3 u_of(double lobe, const Vec2& direction) {
  return {lobe, glm::clamp(direction, 0.0, 1 - 0x1p-53)};
}

/// The u that stands for a delta lobe when it is the only one.
constexpr Vec3 u_of_only_delta{0.5, 0.5, 0.5};

/// a / (a + b), the probability of the first lobe; 0 where both weights are 0.
inline double first_share(double a, double b) { return a > 0 ? a / (a + b) : 0; }

}  // namespace mlt
