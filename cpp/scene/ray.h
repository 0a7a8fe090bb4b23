#pragma once

#include "math/wavelengths.h"

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

/// The times when the shutter opens and closes.
struct Shutter {
  double open = 0, close = 0;

  bool opens() const { return open != close; }  ///< Else it shows one instant.
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
