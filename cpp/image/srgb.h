// The sRGB transfer functions, IEC 61966-2-1:1999, with the standard's own constants.
#pragma once

#include <cmath>

namespace mlt {

/// Decodes a value in [0, 1] to linear light.
inline double srgb_to_linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// Encodes linear light.
inline double linear_to_srgb(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

}  // namespace mlt
