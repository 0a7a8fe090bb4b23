// The lights of a clear day: the sky as an environment map, and the sun as a disk.
#pragma once

#include "scene/emitter/environment_map.h"
#include "scene/emitter/sun_position.h"

namespace mlt {

class Sky final : public EnvironmentMap {
 public:
  Sky(Params& params, const char* scale);

  ObjectPtr copy() const override { return std::make_shared<Sky>(*this); }
};

/// A disk of constant radiance at infinity; without a radius, a delta of direction.
class Sun final : public InfiniteEmitter {
 public:
  Sun(Params& params, const char* scale);

  ObjectPtr copy() const override { return std::make_shared<Sun>(*this); }

  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const override;
  PositionSample sample_position(const Vec2& u, double time) const override;
  double pdf_position(const SurfacePoint& x0) const override;
  Vec2 invert_position(const SurfacePoint& x0) const override;
  bool delta() const override { return height_ == 0; }
  Color power() const override { return irradiance_ * disk_area(); }

 private:
  bool contains(const SurfacePoint& x0) const;

  Frame axes_;        ///< n points towards the middle of the disk.
  double height_;     ///< 1 - cos of its angular radius.
  Color irradiance_;  ///< Irradiance on a surface that faces it.
};

/// Several lights that one plug-in describes.
struct Lights : Object {
  std::vector<EmitterPtr> all;

  ObjectPtr copy() const override {
    auto copied = std::make_shared<Lights>(*this);
    for (EmitterPtr& light : copied->all) light = std::dynamic_pointer_cast<Emitter>(light->copy());
    return copied;
  }
};

}  // namespace mlt
