// A rough Lambertian surface: V-shaped grooves of Lambertian facets, which shadow, mask and light
// each other (Oren & Nayar 1994, "Generalization of Lambert's reflectance model"). sigma is the
// standard deviation of the facets' slope angle; at 0 the surface is Lambert's.
#include "base/registry.h"
#include "scene/bsdf/cosine_sampled.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

class RoughDiffuse final : public CosineSampled {
 public:
  explicit RoughDiffuse(Params& params)
      : reflectance_(texture_param(params, "reflectance")),
        alpha_(texture_param(params, "alpha")),
        fast_(params.boolean("use_fast_approx")) {}

  Spectrum albedo(const SurfacePoint& at) const override { return reflectance_->eval(at); }

 private:
  /// Slopes whose root mean square along one axis is alpha / sqrt(2), as Beckmann's are: sigma.
  Spectrum value(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    const Spectrum rho = reflectance_->eval(at);
    const double sigma2 = 0.5 * sqr(alpha_->eval_scalar(at));
    const double sin_l = std::sqrt(sin2_theta(wl)), sin_c = std::sqrt(sin2_theta(wc));
    const double across = sin_l * sin_c;
    const double cos_phi =
        across > 0 ? std::clamp((wl.x * wc.x + wl.y * wc.y) / across, -1., 1.) : 0;
    const double sin_a = std::max(sin_l, sin_c), tan_b = std::min(sin_l / wl.z, sin_c / wc.z);
    const double a = 1 - 0.5 * sigma2 / (sigma2 + 0.33), b = 0.45 * sigma2 / (sigma2 + 0.09);
    if (fast_)  // eq. 30
      return rho * (inv_pi * (a + b * std::max(0., cos_phi) * sin_a * tan_b));

    const double angle_a = std::asin(std::min(1., sin_a)), angle_b = std::atan(tan_b);
    const double far = 2 * angle_b * inv_pi, both = 4 * angle_a * angle_b * sqr(inv_pi);
    const double c2 = b * (cos_phi >= 0 ? sin_a : sin_a - far * far * far);
    const double c3 = 0.125 * sigma2 / (sigma2 + 0.09) * sqr(both);
    const double once = a + cos_phi * c2 * tan_b +
                        (1 - std::abs(cos_phi)) * c3 * std::tan(0.5 * (angle_a + angle_b));  // 27
    const double twice = 0.17 * sigma2 / (sigma2 + 0.13) * (1 - cos_phi * far * far);        // 28
    return rho * inv_pi * (Spectrum(once) + rho * twice);
  }

  TexturePtr reflectance_, alpha_;
  bool fast_;
};

}  // namespace

Plugin bsdf_roughdiffuse() {
  return make_plugin<RoughDiffuse>(
      "bsdf", "roughdiffuse", "A rough diffuse surface (Oren & Nayar 1994), such as clay.",
      {{"reflectance", ParamType::texture, 0.5, "Fraction of the light that is scattered."},
       {"alpha", ParamType::texture, 0.2,
        "Roughness: sqrt(2) times the standard deviation of the facets' slope."},
       {"use_fast_approx", ParamType::boolean, false,
        "Leave out light between facets, and approximate the rest."}});
}

}  // namespace mlt
