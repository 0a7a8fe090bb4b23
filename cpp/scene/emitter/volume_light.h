// The light of a medium that glows. Its positions lie in the boxes of the shapes that it fills, its
// directions are uniform over the sphere. Where a box reaches beyond the medium sampling fails
// (Scene::find_medium_at_light), so that the density is known for shapes of any form.
#pragma once

#include "math/distribution.h"
#include "scene/emitter/emitter.h"
#include "scene/shape/shape.h"

#include <vector>

namespace mlt {

class VolumeLight final : public Emitter {
 public:
  struct Box {
    Vec3 low, high;
    double filled;  ///< The volume of the shape in it.

    double volume() const;
    bool contains(const Vec3& p) const;
  };

  VolumeLight(MediumPtr medium, std::vector<Box> boxes);

  /// The radiance per unit of length.
  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const override;
  PositionSample sample_position(const Vec2& u, double time) const override {
    return sample_volume(u, 0.5, time);
  }
  double pdf_position(const SurfacePoint&) const override { return 1 / choice_.total(); }
  Vec2 invert_position(const SurfacePoint& x0) const override;
  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override;
  double pdf_ray(const SurfacePoint& x0, const Vec3& w) const override;
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override;
  Color power() const override;

  const Medium* glowing() const override { return medium_.get(); }
  PositionSample sample_volume(const Vec2& u, double third, double time) const override;
  double invert_third(const SurfacePoint& x0) const override;
  void find_box(Vec3& low, Vec3& high) const override;

 private:
  /// The first box around a point, in which it is sampled.
  size_t box_around(const Vec3& p) const;
  /// A place in a box, from 0 to 1.
  static Vec3 place_in(const Box& box, const Vec3& p);

  MediumPtr medium_;
  std::vector<Box> boxes_;
  Discrete choice_;  ///< The choice of a box, by volume.
};

/// The lights of all media that glow inside of these shapes, or of those of their groups.
std::vector<EmitterPtr> volume_lights(const std::vector<ShapePtr>& shapes);

}  // namespace mlt
