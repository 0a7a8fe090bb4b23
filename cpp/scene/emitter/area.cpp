// A surface that shines with the same radiance in all directions on its front side, that of the
// geometric normal.
#include "math/warp.h"
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/surface_light.h"

namespace mlt {
namespace {

class AreaLight final : public SurfaceLight {
 public:
  using SurfaceLight::SurfaceLight;

  PositionSample sample_direct(const Vec3& from, const Vec2& u, double) const override {
    return shape()->sample_direct(from, u);
  }
  double pdf_direct(const Vec3& from, const SurfacePoint& x0) const override {
    return shape()->pdf_direct(from, x0);
  }
  Vec2 invert_direct(const Vec3& from, const SurfacePoint& x0) const override {
    return shape()->invert_direct(from, x0);
  }

  /// Samples in proportion to the cosine, so the coefficient in projected solid angle is 1 / pi.
  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    const Vec3 w = Frame::around(x0.ng).to_world(sample_cosine_hemisphere(u));
    return {x0.p, w, pdf_ray(x0, w)};
  }
  double pdf_ray(const SurfacePoint& x0, const Vec3& w) const override {
    return dot(x0.ng, w) > 0 ? inv_pi : 0;
  }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return invert_cosine_hemisphere(Frame::around(x0.ng).to_local(normalize(x1 - x0.p)));
  }

  const Texture* uniform_radiance() const override {
    return shape()->as_mesh() && radiance().is_constant() ? &radiance() : nullptr;
  }

  Color power() const override { return radiance().mean() * (pi * shape()->area()); }
};

}  // namespace

Plugin emitter_area() {
  return make_emitter_plugin<AreaLight>(
      "area", "Makes the shape that it is nested in glow on its front side.",
      {{"radiance", ParamType::emission, 1.0, "Emitted radiance, which may be textured."}},
      {"caustic_emitter_single", "caustic_emitter_multi"});
}

}  // namespace mlt
