// The common part of the lights that shine from a surface, evenly chosen points of its front side,
// that of the geometric normal.
#pragma once

#include "math/spectrum.h"
#include "scene/emitter/emitter.h"
#include "scene/shape/shape.h"
#include "scene/texture/texture.h"

namespace mlt {

class SurfaceLight : public Emitter {
 public:
  explicit SurfaceLight(Params& params) : radiance_(texture_param(params, "radiance")) {}

  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const override {
    if (!(dot(x0.ng, w) > 0)) return Spectrum(0);
    return max(radiance_->eval(x0), Spectrum(0));
  }

  PositionSample sample_position(const Vec2& u, double) const override {
    return shape_->sample_position(u);
  }
  double pdf_position(const SurfacePoint&) const override { return 1 / shape_->area(); }
  Vec2 invert_position(const SurfacePoint& x0) const override {
    return shape_->invert_position(x0);
  }

  void set_shape(const Shape* shape) override { shape_ = shape; }
  const Shape* shape() const override { return shape_; }

 protected:
  const Texture& radiance() const { return *radiance_; }

 private:
  TexturePtr radiance_;
  const Shape* shape_ = nullptr;
};

}  // namespace mlt
