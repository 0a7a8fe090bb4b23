// A light on a moving shape. Positions are sampled on the shape at rest and transformed to their
// places at the time of the path. An area becomes larger by the factor
//
//   dA / dA_rest = |det M| |M^-T n|
//
// with the linear part M of the transform and the unit normal n at rest, by which densities per
// area are divided.
#pragma once

#include "scene/accel/instance.h"

namespace mlt {

class MovingEmitter final : public Emitter {
 public:
  /// `light` is the light of the one shape of `instance`.
  MovingEmitter(EmitterPtr light, const Instance& instance)
      : light_(std::move(light)), instance_(&instance) {
    set_sampling_weight(light_->sampling_weight());
    id = light_->id;
  }

  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const override {
    return light_->eval(x0, w);
  }

  PositionSample sample_position(const Vec2& u, double time) const override;
  double pdf_position(const SurfacePoint& x0) const override;
  Vec2 invert_position(const SurfacePoint& x0) const override;

  PositionSample sample_direct(const Vec3& from, const Vec2& u, double time) const override;
  double pdf_direct(const Vec3& from, const SurfacePoint& x0) const override;
  Vec2 invert_direct(const Vec3& from, const SurfacePoint& x0) const override;

  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    return light_->sample_ray(x0, u);
  }
  double pdf_ray(const SurfacePoint& x0, const Vec3& w) const override {
    return light_->pdf_ray(x0, w);
  }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return light_->invert_ray(x0, x1);
  }

  bool delta_direction() const override { return light_->delta_direction(); }

  /// Emitted power for the mean area, as if the shape were scaled evenly.
  Color power() const override;
  const Shape* shape() const override { return light_->shape(); }

 private:
  PositionSample moved(PositionSample at_rest, double time) const;

  EmitterPtr light_;
  const Instance* instance_;
};

}  // namespace mlt
