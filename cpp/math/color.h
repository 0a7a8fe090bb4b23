// Linear Rec. 709 / sRGB-primaries colour, of images and of scene descriptions, and the scalar that
// Metropolis sampling targets.
#pragma once

#include "math/number.h"

namespace mlt {

using Color = Vec3;

inline bool is_black(const Color& c) { return c.x == 0 && c.y == 0 && c.z == 0; }
inline bool is_grey(const Color& c) { return c.x == c.y && c.y == c.z; }

inline double mean(const Color& c) { return (c.x + c.y + c.z) / 3; }

/// Rec. 709 luminance (ITU-R BT.709, sec. 3).
template <class F>
F luminance(const Vec3Of<F>& c) {
  return number<F>(0.2126) * c.x + number<F>(0.7152) * c.y + number<F>(0.0722) * c.z;
}

/// The scalar target L* = (luminance + mean of R, G, B) / 2. Since L* >= 0.2 of every channel,
/// RGB / L* is bounded and a saturated colour cannot become a speckle.
inline double target_luminance(const Color& c) {
  return 0.5 * (luminance(c) + (c.x + c.y + c.z) / 3);
}

}  // namespace mlt
