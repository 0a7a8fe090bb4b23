// Rough plastic: a diffuse base below a rough dielectric coating. The coating reflects as
// microfacets do (Walter et al. 2007, eq. 20); its transmittance T is tabulated:
//   f = F D G / (4 cos_l cos_c) + d / (1 - d R_i) T(wl) T(wc) / (pi eta^2)
// with d the reflectance of the base and R_i the mean reflectance of the coating from inside (or
// 1 - R_i in the linear variant), as for smooth plastic.
#include "base/registry.h"
#include "math/fresnel.h"
#include "math/warp.h"
#include "scene/bsdf/coated_base.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/rough_coating.h"
#include "scene/bsdf/rough_surface.h"
#include "scene/bsdf/smooth_reflector.h"

namespace mlt {
namespace {

class RoughPlastic final : public SmoothReflector<RoughPlastic> {
 public:
  explicit RoughPlastic(Params& params)
      : eta_(relative_ior_param(params)),
        microfacet_(isotropic_microfacet_param(params)),
        coating_(microfacet_.type(), microfacet_.alpha_u(), eta_),
        base_(params, eta_, coating_.internal_reflectance(), coating_.mean_transmittance()) {
    supports_lanes_ = fits_lanes(microfacet_);
  }

  template <class F>
  auto point(const SurfacePoint* const*) const {
    if constexpr (is_number<F>)
      return microfacet_;
    else
      return Ggx<F>{number<F>(microfacet_.alpha_u()), number<F>(microfacet_.alpha_v())};
  }

  template <class F>
  struct Terms {
    F specular, diffuse, pdf_from_light, pdf_from_camera;
    Terms<double> of_lane(int i) const { return {specular[i], diffuse[i], 0, 0}; }
  };
  template <class Normals, class F>
  Terms<F> terms(const Normals& microfacet, const Vec3Of<F>& wl, const Vec3Of<F>& wc) const {
    const MicrofacetReflection mirror(microfacet, wl, wc);
    const RoughFresnelOf<F> coat_l = coating_.at(wl.z), coat_c = coating_.at(wc.z);
    const F pl = specular_share(coat_l), pc = specular_share(coat_c);
    const F reflected = dielectric_reflectance(dot(wl, mirror.h), eta_);
    return {reflected * mirror.DG / (4 * wl.z * wc.z), coat_l.transmittance * coat_c.transmittance,
            pl * mirror.pdf_from_light + (1 - pl) * number<F>(inv_pi) * wc.z,
            pc * mirror.pdf_from_camera + (1 - pc) * number<F>(inv_pi) * wl.z};
  }

  template <class Normals, class F>
  Vec3Of<F> direction(const Normals& microfacet, const Vec3Of<F>& from, const Vec3Of<F>& u) const {
    const Vec2Of<F> v(u.y, u.z);
    const auto below_coat = u.x >= specular_share(coating_.at(from.z));
    if constexpr (is_number<F>)
      return below_coat ? sample_cosine_hemisphere(v) : mirrored(microfacet, from, v);
    else
      return select(below_coat, sample_cosine_hemisphere(v), mirrored(microfacet, from, v));
  }

  struct Colors {
    Spectrum specular, base;
  };
  Colors colors(const SurfacePoint& at) const { return {base_.specular(at), base_.eval(at)}; }
  Spectrum value(const Colors& colors, const Terms<double>& terms) const {
    return terms.specular * colors.specular + terms.diffuse * colors.base;
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    const double total = pdf(at, from, to, lobe);
    if (!(total > 0)) return std::nullopt;
    const double p = specular_share(coating_.at(from.z));
    const double lambertian = (1 - p) * inv_pi * to.z;
    const LobeGuess guess = guess_lobe(std::max(0.0, total - lambertian), lambertian, v.x);
    if (guess.first)
      return u_of(u_of_first(p, guess.rest), microfacet_.invert(from, normalize(from + to)));
    return u_of(u_of_second(p, guess.rest), invert_cosine_hemisphere(to));
  }

  /// The roughness of the lobe that contributes more between the two directions.
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    if (!above(wl, wc)) return infinity;
    const Terms<double> terms = this->terms(microfacet_, wl, wc);
    const auto [specular, base] = colors(at);
    return target_luminance(terms.specular * specular) > target_luminance(terms.diffuse * base)
               ? microfacet_.alpha_u()
               : infinity;
  }

  double least_roughness() const override { return microfacet_.alpha_u(); }

  Spectrum albedo(const SurfacePoint& at) const override { return base_.albedo(at); }

 private:
  template <class F>
  F specular_share(const RoughFresnelOf<F>& coat) const {
    return base_.specular_share(coat.reflectance, coat.transmittance);
  }

  double eta_;
  Microfacet microfacet_;
  RoughCoating coating_;
  CoatedBase base_;
};

}  // namespace

Plugin bsdf_roughplastic() {
  return make_plugin<RoughPlastic>(
      "bsdf", "roughplastic", "Rough plastic: a diffuse base below a rough transparent coating.",
      concat({ior_parameters("polypropylene"), isotropic_microfacet_parameters(),
              CoatedBase::parameters()}));
}

}  // namespace mlt
