// A light of no size that emits equally in all directions.
#include "math/warp.h"
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/isolated.h"
#include "scene/emitter/lamp_color.h"
#include "scene/transform/transform_params.h"

namespace mlt {
namespace {

class PointLight final : public IsolatedEmitter {
 public:
  explicit PointLight(Params& params)
      : IsolatedEmitter(read_motion(params)), intensity_(params, "intensity") {}

  Spectrum eval(const SurfacePoint& x0, const Vec3&) const override { return intensity_.at(x0); }

  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    return {x0.p, sample_uniform_sphere(u), uniform_sphere_pdf()};
  }
  double pdf_ray(const SurfacePoint&, const Vec3&) const override { return uniform_sphere_pdf(); }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return invert_uniform_sphere(normalize(x1 - x0.p));
  }

  Color power() const override { return intensity_.mean() * (4 * pi); }

 private:
  static Motion read_motion(Params& params) {
    if (!params.has("position")) return motion_param(params, "to_world");
    if (params.has("to_world")) params.fail("to_world", "and 'position' exclude each other");
    Mat4 to_world(1);
    to_world[3] = Vec4(vector_param(params, "position"), 1);
    return Motion(to_world);
  }

  LampColor intensity_;
};

}  // namespace

Plugin emitter_point() {
  return make_emitter_plugin<PointLight>(
      "point", "A light of no size that shines equally in all directions.",
      {{"intensity", ParamType::lamp, 1.0, "Power per solid angle."},
       {"position", ParamType::point, no_default, "Where it is; the origin if not given."},
       {"to_world", ParamType::motion, no_default,
        "Moves the origin there, instead of position."}});
}

}  // namespace mlt
