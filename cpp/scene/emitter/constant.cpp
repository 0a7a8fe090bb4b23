// A sky of the same radiance in all directions.
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/infinite.h"
#include "scene/emitter/lamp_color.h"

namespace mlt {
namespace {

class ConstantSky final : public InfiniteEmitter {
 public:
  explicit ConstantSky(Params& params) : radiance_(params, "radiance") {}

  Spectrum eval(const SurfacePoint& x0, const Vec3&) const override { return radiance_.at(x0); }

  PositionSample sample_position(const Vec2& u, double) const override {
    return {point_towards(sample_uniform_sphere(u)), uniform_sphere_pdf()};
  }
  double pdf_position(const SurfacePoint&) const override { return uniform_sphere_pdf(); }
  Vec2 invert_position(const SurfacePoint& x0) const override {
    return invert_uniform_sphere(x0.p);
  }

  Color power() const override { return radiance_.mean() * (4 * pi * disk_area()); }

 private:
  LampColor radiance_;
};

}  // namespace

Plugin emitter_constant() {
  return make_emitter_plugin<ConstantSky>(
      "constant", "A sky of the same radiance in all directions.",
      {{"radiance", ParamType::lamp, 1.0, "Radiance of the sky."}}, {"to_world"});
}

}  // namespace mlt
