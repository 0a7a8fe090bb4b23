// A surface that shines along its normals alone. Its radiance is a delta of direction, whose
// coefficient in projected solid angle is the power per area (as in Mitsuba 3).
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/surface_light.h"

namespace mlt {
namespace {

class DirectionalAreaLight final : public SurfaceLight {
 public:
  using SurfaceLight::SurfaceLight;

  PositionSample sample_direct(const Vec3&, const Vec2&, double) const override { return {}; }
  double pdf_direct(const Vec3&, const SurfacePoint&) const override { return 0; }

  RaySample sample_ray(const SurfacePoint& x0, const Vec2&) const override {
    return {x0.p, x0.shading.n, 1};
  }
  double pdf_ray(const SurfacePoint&, const Vec3&) const override { return 1; }
  Vec2 invert_ray(const SurfacePoint&, const Vec3&) const override { return Vec2(0.5); }

  bool delta_direction() const override { return true; }

  Color power() const override { return radiance().mean() * shape()->area(); }
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
