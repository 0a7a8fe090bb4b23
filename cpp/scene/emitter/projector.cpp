// A slide projector: a pinhole that casts an image. As in Mitsuba 3, the image is the radiance of a
// white diffuse plane at unit distance, across the axis: there the irradiance is pi times the
// image, and E = I cos^3 / 1^2, so the intensity is I = pi image / cos^3.
#include "scene/camera/projective.h"
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/isolated.h"
#include "scene/texture/texture.h"
#include "scene/transform/orientation.h"

namespace mlt {
namespace {

class Projector final : public TurnedEmitter {
 public:
  explicit Projector(Params& params)
      : TurnedEmitter(turning_motion_param(params), turned_axes),
        irradiance_(texture_param(params, "irradiance")),
        scale_(params.real_in("scale", 0, 1e9)) {
    const Vec2 size(irradiance_->resolution());
    half_ = read_view(params).half_size(size.x / size.y);
  }

  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const override {
    const Vec3 local = axes(x0.time).to_local(w);
    const auto u = place(local);
    if (!u) return Spectrum(0);
    SurfacePoint at;
    at.time = x0.time;
    at.wavelength = x0.wavelength;
    at.uv = *u;
    return irradiance_->eval(at) * (pi * scale_ / cube(local.z));
  }

  /// Samples a direction uniformly over the image.
  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    const Vec3 local = normalize(Vec3(half_ * (1.0 - 2.0 * u), 1));
    return {x0.p, axes(x0.time).to_world(local), density(local)};
  }
  double pdf_ray(const SurfacePoint& x0, const Vec3& w) const override {
    const Vec3 local = axes(x0.time).to_local(w);
    return place(local) ? density(local) : 0;
  }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return place(axes(x0.time).to_local(normalize(x1 - x0.p))).value_or(Vec2(0.5));
  }

  Color power() const override { return irradiance_->mean() * (pi * scale_ * area()); }

 private:
  static double cube(double x) { return x * x * x; }
  double area() const { return 4 * half_.x * half_.y; }
  double density(const Vec3& local) const { return 1 / (area() * cube(local.z)); }

  /// The position of a direction in the image, (0, 0) to (1, 1) from its upper left corner.
  std::optional<Vec2> place(const Vec3& local) const {
    if (!(local.z > 0)) return std::nullopt;
    const Vec2 u = 0.5 * (1.0 - Vec2(local) / (local.z * half_));
    const auto inside = [](double x) { return x >= -1e-12 && x <= 1 + 1e-12; };
    if (!inside(u.x) || !inside(u.y)) return std::nullopt;
    return glm::clamp(u, Vec2(0), Vec2(1));
  }

  TexturePtr irradiance_;
  double scale_;
  Vec2 half_;  ///< Half the image's width and height at unit distance.
};

}  // namespace

Plugin emitter_projector() {
  return emitter_plugin(
      "projector", "A pinhole that casts an image, as a slide projector does.",
      concat({{{"irradiance", ParamType::emission, 1.0,
                "The image: what a white plane shows, at unit distance across the axis."},
               {"scale", ParamType::real, 1.0, "Multiplies the image."},
               {"to_world", ParamType::motion, no_default,
                "Moves and turns it: it shines along +z, +y is up and +x is to the left."}},
              field_of_view_parameters()}),
      {}, [](Params& params) { return std::make_shared<Projector>(params); });
}

}  // namespace mlt
