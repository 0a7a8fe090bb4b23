// A light of no size whose intensity is an image of all directions, in the layout of
// EnvironmentMap: the map that is radiance from infinitely far away there is power per solid angle
// here, and directions are drawn alike.
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/environment_map.h"
#include "scene/emitter/isolated.h"
#include "scene/emitter/sphere_image.h"
#include "scene/texture/load_texels.h"
#include "scene/transform/orientation.h"

namespace mlt {
namespace {

class Goniometric final : public TurnedEmitter {
 public:
  explicit Goniometric(Params& params)
      : TurnedEmitter(turning_motion_param(params), turned_axes),
        map_(load_sphere_image(params), turned_axes(Mat4(1)), read_scale(params)) {}

  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const override {
    return map_.eval(towards(x0, w), w);
  }

  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    const PositionSample direction = map_.sample_position(u, x0.time);
    return {x0.p, axes(x0.time).to_world(direction.at.p), direction.pdf};
  }
  double pdf_ray(const SurfacePoint& x0, const Vec3& w) const override {
    return map_.pdf_position(towards(x0, w));
  }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return map_.invert_position(towards(x0, normalize(x1 - x0.p)));
  }

  Color power() const override { return map_.integral(); }

 private:
  /// The point of the map in the direction w.
  SurfacePoint towards(const SurfacePoint& x0, const Vec3& w) const {
    SurfacePoint at = InfiniteEmitter::point_towards(axes(x0.time).to_local(w));
    at.wavelength = x0.wavelength;
    return at;
  }

  EnvironmentMap map_;
};

}  // namespace

Plugin emitter_goniometric() {
  return make_emitter_plugin<Goniometric>(
      "goniometric", "A light of no size whose intensity is a latitude-longitude image.",
      concat({image_parameters("Image file: the power per solid angle into each direction."),
              {{"scale", ParamType::real, 1.0, "Multiplies the image."},
               {"to_world", ParamType::motion, no_default,
                "Moves and turns it: +y is the image's first row, -z the middle of its sides."}}}));
}

}  // namespace mlt
