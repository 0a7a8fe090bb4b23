#pragma once

#include "math/wavelengths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace mlt {

/// The place of a medium in Media; `no_medium` is empty space.
using MediumIndex = uint16_t;
inline constexpr MediumIndex no_medium = 0xffff;

struct Ray {
  Vec3 o;
  Vec3 d;  ///< Unit length.
  double time = 0;
  double t_max = infinity;
  MediumIndex medium = no_medium;  ///< In which it starts.
  double before = 0;              ///< In media: how far the start of its edge is before the origin.
  double wavelength = rgb_lanes;  ///< See wavelengths.h.
};

/// The distance of a point of the ray from the start of its edge.
inline double distance_to(const Vec3& p, const Ray& ray) {
  return ray.before + dot(p - ray.o, ray.d);
}

/// The times when the shutter opens first and closes last. Between them it may have several
/// exposures, the frames of a shot: they begin at equal distances.
struct Shutter {
  double open = 0, close = 0;
  int exposures = 1;
  double share = 1;  ///< The share of that distance for which it is open.

  bool opens() const { return open != close; }  ///< Else it shows one instant.
  /// A time for a uniform number.
  double time(double u) const {
    if (exposures == 1) return open + u * share * (close - open);
    const double place = u * exposures, first = std::min(std::floor(place), exposures - 1.0);
    return open + (first + (place - first) * share) * (close - open) / exposures;
  }
  /// The number for a time, if it opens.
  double number(double time) const {
    const double place = (time - open) / (close - open) * exposures, first = exposure(time);
    return share > 0 ? (first + (place - first) / share) / exposures : first / exposures;
  }
  /// The exposure that a time belongs to.
  int exposure(double time) const {
    constexpr double rounding = 1e-9;
    const double place = opens() ? (time - open) / (close - open) * exposures : 0;
    return static_cast<int>(std::clamp(std::floor(place + rounding), 0.0, exposures - 1.0));
  }
};

/// A hit of the accelerator: the primitive, and the barycentrics of Embree on it.
struct Hit {
  double t;
  uint32_t shape;
  uint32_t primitive;
  float u, v;
  uint32_t member = 0;  ///< Index of the shape in the group of an instance.
};

}  // namespace mlt
