// A light of no size that shines into a cone about its z axis: with full intensity up to the angle
// `beam_width`, from there on falling linearly with the angle to 0 at `cutoff_angle`.
#include "math/warp.h"
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/isolated.h"
#include "scene/emitter/lamp_color.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

Frame beam_axes(const Mat4& to_world) {
  return Frame::around(normalize(transform_vector(to_world, Vec3(0, 0, 1))),
                       transform_vector(to_world, Vec3(1, 0, 0)));
}

class Spot final : public TurnedEmitter {
 public:
  explicit Spot(Params& params)
      : TurnedEmitter(motion_param(params, "to_world"), beam_axes),
        intensity_(params, "intensity"),
        texture_(texture_param(params, "texture")) {
    const double cutoff = params.real_in("cutoff_angle", 1e-3, 179.999);
    const double beam =
        params.has("beam_width") ? params.real_in("beam_width", 0, cutoff) : 0.75 * cutoff;
    cutoff_ = cutoff * degree;
    beam_ = beam * degree;
    height_ = 2 * sqr(std::sin(cutoff_ / 2));
    for (const Mat4& step : motion_.steps())
      if (!(length(transform_vector(step, Vec3(0, 0, 1))) > 0))
        params.fail("to_world", "leaves no direction to shine in");
    if (params.has("texture") && cutoff >= 90)
      params.fail("texture", "needs a cutoff_angle below 90 degrees");
  }

  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const override {
    const Frame frame = axes(x0.time);
    const double theta = std::atan2(length(cross(frame.n, w)), dot(frame.n, w));
    if (theta >= cutoff_) return Spectrum(0);
    const double share = theta <= beam_ ? 1 : (cutoff_ - theta) / (cutoff_ - beam_);
    return intensity_.at(x0) * texture(frame.to_local(w), x0) * share;
  }

  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    return {x0.p, axes(x0.time).to_world(sample_cone(u, height_)), cone_pdf(height_)};
  }
  double pdf_ray(const SurfacePoint& x0, const Vec3& w) const override {
    return 1 - dot(axes(x0.time).n, w) <= height_ * (1 + 1e-12) ? cone_pdf(height_) : 0;
  }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return invert_cone(axes(x0.time).to_local(normalize(x1 - x0.p)), height_);
  }

  /// The integral of the intensity over the cone, with the mean of the texture.
  Color power() const override {
    const double width = cutoff_ - beam_;
    const double slope =
        width > 0 ? (std::sin(cutoff_) - std::sin(beam_)) / width : std::cos(beam_);
    return intensity_.mean() * texture_->mean() * (2 * pi * (1 - slope));
  }

 private:
  /// The texture, projected on a plane across the axis, of which the cone fills the unit square.
  Spectrum texture(const Vec3& local, const SurfacePoint& x0) const {
    SurfacePoint at;
    at.time = x0.time;
    at.wavelength = x0.wavelength;
    at.uv = Vec2(0.5) + 0.5 * Vec2(local) / (local.z * std::tan(cutoff_));
    return texture_->eval(at);
  }

  LampColor intensity_;
  TexturePtr texture_;
  double cutoff_, beam_;  ///< In radians.
  double height_;         ///< 1 - cos(cutoff)
};

}  // namespace

Plugin emitter_spot() {
  return make_emitter_plugin<Spot>(
      "spot", "A light of no size that shines into a cone about its z axis.",
      {{"intensity", ParamType::lamp, 1.0, "Power per solid angle within the beam."},
       {"cutoff_angle", ParamType::real, 20.0,
        "Beyond this angle from the axis it is dark, degrees."},
       {"beam_width", ParamType::real, no_default,
        "Up to this angle it has its full intensity, degrees; by default 3/4 of cutoff_angle."},
       {"texture", ParamType::emission, 1.0, "A factor of the intensity, such as a slide."},
       {"to_world", ParamType::motion, no_default, "Moves and turns it."}});
}

}  // namespace mlt
