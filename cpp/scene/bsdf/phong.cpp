// The modified Phong model: a diffuse part and a lobe cos^n about the mirror direction (Phong 1975;
// made reciprocal and normalised by Lafortune & Willems 1994, "Using the modified Phong reflectance
// model for physically based rendering"):
//   f = k_d / pi + k_s (n + 2) / (2 pi) cos^n alpha.
#include "base/registry.h"
#include "math/warp.h"
#include "scene/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture.h"

namespace mlt {
namespace {

/// The factor on both reflectances that keeps their sum below 1: the rule of Mitsuba 0.6, which
/// leaves a margin of 1 % where it acts.
double energy_scale(const Color& largest) {
  const double sum = max_component(largest);
  return sum > 1 ? 0.99 / sum : 1;
}

class Phong final : public Bsdf {
 public:
  explicit Phong(Params& params)
      : diffuse_(texture_param(params, "diffuse_reflectance")),
        specular_(texture_param(params, "specular_reflectance")),
        exponent_(params.real_in("exponent", 0, 1e9)) {
    if (params.boolean("ensure_energy_conservation"))
      scale_ = energy_scale(diffuse_->maximum() + specular_->maximum());
    specular_share_ =
        first_share(target_luminance(specular_->mean()), target_luminance(diffuse_->mean()));
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    const double cos_n = power(wl, wc);
    const double specular = specular_pdf(cos_n);
    return {diffuse_part(at) + specular_part(at, cos_n), diffuse_pdf(wc) + specular,
            diffuse_pdf(wl) + specular};
  }

  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z <= 0) return std::nullopt;
    const Vec3 to = u.x < specular_share_ ? sample_lobe(direction_part(u), reflect(from), exponent_)
                                          : sample_cosine_hemisphere(direction_part(u));
    if (to.z <= 0) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to,
                             Lobe lobe) const override {
    if (!(pdf(at, from, to, lobe) > 0)) return std::nullopt;
    if (specular_pdf(power(from, to)) > diffuse_pdf(to))
      return u_of(u_of_first(specular_share_), invert_lobe(to, reflect(from), exponent_));
    return u_of(u_of_second(specular_share_), invert_cosine_hemisphere(to));
  }

  /// A lobe cos^n is as wide as a Beckmann lobe with alpha^2 = 2 / (n + 2) (Walter et al. 2007,
  /// sec. 5.2); where the diffuse part is the larger one, the surface counts as diffuse.
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    if (!above(wl, wc)) return infinity;
    const double specular = target_luminance(specular_part(at, power(wl, wc)));
    return specular > target_luminance(diffuse_part(at)) ? std::sqrt(2 / (exponent_ + 2))
                                                         : infinity;
  }

  Color albedo(const SurfacePoint& at) const override {
    return scale_ * (diffuse_->eval(at) + specular_->eval(at));
  }

 private:
  /// cos^n of the angle to the mirror direction: the same from either side.
  double power(const Vec3& a, const Vec3& b) const {
    const double cos_alpha = dot(reflect(a), b);
    return cos_alpha > 0 ? std::pow(std::min(cos_alpha, 1.0), exponent_) : 0;
  }

  Color diffuse_part(const SurfacePoint& at) const { return scale_ * inv_pi * diffuse_->eval(at); }
  Color specular_part(const SurfacePoint& at, double cos_n) const {
    return scale_ * (exponent_ + 2) * (0.5 * inv_pi) * cos_n * specular_->eval(at);
  }

  double diffuse_pdf(const Vec3& to) const { return (1 - specular_share_) * inv_pi * to.z; }
  double specular_pdf(double cos_n) const {
    return specular_share_ * (exponent_ + 1) * (0.5 * inv_pi) * cos_n;
  }

  TexturePtr diffuse_, specular_;
  double exponent_;
  double scale_ = 1;
  double specular_share_;
};

}  // namespace

Plugin bsdf_phong() {
  return make_plugin<Phong>(
      "bsdf", "phong",
      "The modified Phong model: a diffuse part and a glossy lobe about the mirror direction.",
      {{"exponent", ParamType::real, 30.0, "Exponent of the glossy lobe; larger is shinier."},
       {"specular_reflectance", ParamType::texture, 0.2, "Reflectance of the glossy lobe."},
       {"diffuse_reflectance", ParamType::texture, 0.5, "Reflectance of the diffuse part."},
       {"ensure_energy_conservation", ParamType::boolean, true,
        "If the largest values of both reflectances add up to more than 1, scale both so that "
        "they add up to 0.99. Without it the surface may reflect more than it receives."}});
}

}  // namespace mlt
