// Equiangular sampling: distances along a ray at which the directions to a light are uniform in
// angle, so that its 1 / d^2 cancels (C. Kulla and M. Fajardo, "Importance sampling techniques for
// path tracing in participating media", Computer Graphics Forum 31(4), 2012).
#pragma once

#include "math/vec.h"

#include <cmath>

namespace mlt {

class Equiangular {
 public:
  /// For no distance.
  Equiangular() = default;
  /// For distances from 0 up to `most`, which may be infinite, along the ray from `start` in the
  /// direction w, and light from this point.
  Equiangular(const Vec3& start, const Vec3& w, double most, const Vec3& light)
      : nearest_(dot(light - start, w)),
        height_(length(light - start - nearest_ * w)),
        first_(std::atan2(-nearest_, height_)),
        angle_(std::atan2(most - nearest_, height_) - first_) {}

  /// The angle between the first and the last, as seen from the light.
  double angle() const { return angle_; }
  double sample(double u) const { return nearest_ + height_ * std::tan(first_ + u * angle_); }
  /// Density of a distance; 0 on a ray through the light.
  double pdf(double distance) const {
    if (!(angle_ > 0 && height_ > 0)) return 0;
    return height_ / (angle_ * (sqr(height_) + sqr(distance - nearest_)));
  }

 private:
  double nearest_ = 0;  ///< The distance at which the ray is nearest to the light,
  double height_ = 0;   ///< and how near.
  double first_ = 0;    ///< The angle of the start.
  double angle_ = 0;
};

}  // namespace mlt
