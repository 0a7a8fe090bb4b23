// The common part of cameras whose image is not a plane but a piece of the sphere of directions
// around a point. There is no lens that faces a side, and so no cosine: the point is isolated, like
// a point light, and densities of directions are in solid angle.
#pragma once

#include "scene/camera/placement.h"

namespace mlt {

class PanoramicCamera : public PlacedCamera {
 public:
  using PlacedCamera::PlacedCamera;

  PositionSample sample_position(const Vec2& u, double time) const override;
  double pdf_position(const SurfacePoint&) const override { return 1; }
  Vec2 invert_position(const SurfacePoint&) const override { return Vec2(0.5); }
  Vec3 direction(const SurfacePoint& xk, const Vec2& raster) const override {
    return xk.shading.to_world(look(raster + Vec2(raster_.crop_offset)));
  }
  std::optional<Projection> project(const SurfacePoint& xk, const Vec3& w) const override;
  bool delta_position() const override { return true; }

 protected:
  /// Where a direction is seen.
  struct Sight {
    Vec2 position;                ///< Its position on the whole image, in pixels.
    double pixels_per_steradian;  ///< Area of the image over solid angle.
  };

 private:
  /// The direction in camera space for a position on the whole image.
  virtual Vec3 look(const Vec2& position) const = 0;
  /// The inverse of look(); nullopt if the direction is not seen.
  virtual std::optional<Sight> find(const Vec3& w) const = 0;
};

}  // namespace mlt
