// A surface that shines along its normals alone. Its radiance is a delta of direction, whose
// coefficient in projected solid angle is the power per area (as in Mitsuba 3).
#include "scene/emitter.h"
#include "scene/emitter/emitter_plugin.h"
#include "scene/shape.h"
#include "scene/texture.h"

namespace mlt {
namespace {

class DirectionalAreaLight final : public Emitter {
 public:
  explicit DirectionalAreaLight(Params& params) : radiance_(texture_param(params, "radiance")) {}

  Color eval(const SurfacePoint& x0, const Vec3& w) const override {
    if (!(dot(x0.ng, w) > 0)) return Color(0);
    return glm::max(radiance_->eval(x0), Color(0));
  }

  PositionSample sample_position(const Vec2& u, double) const override {
    return shape_->sample_position(u);
  }
  double pdf_position(const SurfacePoint&) const override { return 1 / shape_->area(); }
  Vec2 invert_position(const SurfacePoint& x0) const override {
    return shape_->invert_position(x0);
  }

  PositionSample sample_direct(const Vec3&, const Vec2&, double) const override { return {}; }
  double pdf_direct(const Vec3&, const SurfacePoint&) const override { return 0; }

  RaySample sample_ray(const SurfacePoint& x0, const Vec2&) const override {
    return {x0.p, x0.shading.n, 1};
  }
  double pdf_ray(const SurfacePoint&, const Vec3&) const override { return 1; }
  Vec2 invert_ray(const SurfacePoint&, const Vec3&) const override { return Vec2(0.5); }

  bool delta_direction() const override { return true; }

  Color power() const override { return radiance_->mean() * shape_->area(); }

  void set_shape(const Shape* shape) override { shape_ = shape; }
  const Shape* shape() const override { return shape_; }

 private:
  TexturePtr radiance_;
  const Shape* shape_ = nullptr;
};

}  // namespace

Plugin emitter_directionalarea() {
  return make_emitter_plugin<DirectionalAreaLight>(
      "directionalarea",
      "Makes the shape that it is nested in shine along its normals alone, such as a beam of "
      "parallel light. Only walks that start at the light can find it: bdpt, ptracer, mlt, not "
      "path.",
      {{"radiance", ParamType::emission, 1.0, "Power per area, which may be textured."}});
}

}  // namespace mlt
