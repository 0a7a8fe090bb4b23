// The light of a medium that glows. Its positions lie in the boxes of the shapes that it fills, and
// where the medium varies, more of them in the cells of a box that are brighter; its directions are
// uniform over the sphere. Where a box reaches beyond the medium sampling fails
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
  double pdf_position(const SurfacePoint& x0) const override;
  Vec2 invert_position(const SurfacePoint& x0) const override;
  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override;
  double pdf_ray(const SurfacePoint& x0, const Vec3& w) const override;
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override;
  /// 4 pi times the integral of the emission over the shapes, as if none lay in another one, and as
  /// if each were spread evenly over its box.
  Color power() const override { return power_; }

  const Medium* glowing() const override { return medium_.get(); }
  PositionSample sample_volume(const Vec2& u, double third, double time) const override;
  double invert_third(const SurfacePoint& x0) const override;
  void find_box(Vec3& low, Vec3& high) const override;

 private:
  /// A cell, counted over those of all boxes, and a place in it, from 0 to 1.
  struct Place {
    size_t cell;
    Vec3 in_cell;
  };
  size_t box_around(const Vec3& p) const;
  Place place_of(const Vec3& p) const;
  Vec3 point_at(const Place& place) const;

  size_t cells_of_box() const { return size_t(resolution_) * resolution_ * resolution_; }
  const Box& box_of(size_t cell) const { return boxes_[cell / cells_of_box()]; }
  double cell_volume(size_t cell) const { return box_of(cell).volume() / cells_of_box(); }
  Color mean_emission(size_t cell) const;

  MediumPtr medium_;
  std::vector<Box> boxes_;
  int resolution_;   ///< Cells along each axis of a box.
  Discrete choice_;  ///< The choice of a cell.
  Color power_{0};
};

/// The lights of all media that glow inside of these shapes, or of those of their groups.
std::vector<EmitterPtr> volume_lights(const std::vector<ShapePtr>& shapes);

}  // namespace mlt
