// A light of no size that shines equally in all directions.
#include "base/registry.h"
#include "math/warp.h"
#include "scene/emitter.h"
#include "scene/texture.h"

namespace mlt {
namespace {

class PointLight final : public Emitter {
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

  PositionSample sample_position(const Vec2&) const override {
    SurfacePoint at;
    at.p = position_;
    at.ng = {0, 0, 1};
    at.kind = PointKind::isolated;
    return {at, 1};
  }
  double pdf_position(const SurfacePoint&) const override { return 1; }
  Vec2 invert_position(const SurfacePoint&) const override { return Vec2(0.5); }

  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    return {x0.p, sample_uniform_sphere(u), uniform_sphere_pdf()};
  }
  double pdf_ray(const SurfacePoint&, const Vec3&) const override { return uniform_sphere_pdf(); }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return invert_uniform_sphere(normalize(x1 - x0.p));
  }

  bool delta() const override { return true; }
  Color power() const override { return intensity_ * (4 * pi); }

 private:
  Color intensity_;
  Vec3 position_{0};
};

}  // namespace

Plugin emitter_point() {
  return make_plugin<PointLight>(
      "emitter", "point", "A light of no size that shines equally in all directions.",
      {{"intensity", ParamType::radiance, 1.0, "Power per solid angle."},
       {"position", ParamType::point, no_default, "Where it is; the origin if not given."},
       {"to_world", ParamType::transform, no_default,
        "Moves the origin there, instead of position."}},
      {"sampling_weight"});
}

}  // namespace mlt
