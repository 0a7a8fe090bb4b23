// The placement of a texture on the uv square: a linear map of (u, v, 1), given as Mitsuba 3's
// `to_uv` or as the offsets and scales of Mitsuba 0.6.
#pragma once

#include "base/params.h"
#include "math/vec.h"

namespace mlt {

class UvTransform {
 public:
  /// Reads to_uv, uoffset, voffset, uscale, vscale and uvscale.
  explicit UvTransform(Params& params);

  Vec2 operator()(const Vec2& uv) const {
    return {u_.x * uv.x + u_.y * uv.y + u_.z, v_.x * uv.x + v_.y * uv.y + v_.z};
  }
  /// Transforms derivatives by the mapped coordinates to those by the given ones.
  Vec2 pull_back(const Vec2& gradient) const {
    return {u_.x * gradient.x + v_.x * gradient.y, u_.y * gradient.x + v_.y * gradient.y};
  }

 private:
  Vec3 u_{1, 0, 0}, v_{0, 1, 0};  // rows of the map
};

std::vector<Parameter> uv_parameters();

}  // namespace mlt
