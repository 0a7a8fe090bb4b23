// A light of no size that shines equally in all directions.
#include "math/warp.h"
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/isolated.h"
#include "scene/texture.h"

namespace mlt {
namespace {

class PointLight final : public IsolatedEmitter {
 public:
  explicit PointLight(Params& params) : intensity_(color_param(params, "intensity")) {
    if (params.has("position")) {
      if (params.has("to_world")) params.fail("to_world", "and 'position' exclude each other");
      position_ = vector_param(params, "position");
    } else {
      position_ = transform_point(matrix_param(params, "to_world"), Vec3(0));
    }
  }

  Color eval(const SurfacePoint&, const Vec3&) const override { return intensity_; }

  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    return {x0.p, sample_uniform_sphere(u), uniform_sphere_pdf()};
  }
  double pdf_ray(const SurfacePoint&, const Vec3&) const override { return uniform_sphere_pdf(); }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return invert_uniform_sphere(normalize(x1 - x0.p));
  }

  Color power() const override { return intensity_ * (4 * pi); }

 private:
  Color intensity_;
};

}  // namespace

Plugin emitter_point() {
  return make_emitter_plugin<PointLight>(
      "point", "A light of no size that shines equally in all directions.",
      {{"intensity", ParamType::radiance, 1.0, "Power per solid angle."},
       {"position", ParamType::point, no_default, "Where it is; the origin if not given."},
       {"to_world", ParamType::transform, no_default,
        "Moves the origin there, instead of position."}});
}

}  // namespace mlt
