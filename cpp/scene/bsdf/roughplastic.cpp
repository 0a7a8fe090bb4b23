// Rough plastic: a diffuse base below a rough dielectric coating. The coating reflects as
// microfacets do (Walter et al. 2007, eq. 20); its transmittance T is tabulated:
//   f = F D G / (4 cos_l cos_c) + d / (1 - d R_i) T(wl) T(wc) / (pi eta^2)
// with d the reflectance of the base and R_i the mean reflectance of the coating from inside (or
// 1 - R_i in the linear variant), as for smooth plastic.
#include "base/registry.h"
#include "math/fresnel.h"
#include "math/warp.h"
#include "scene/bsdf.h"
#include "scene/bsdf/coated_base.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/rough_coating.h"
#include "scene/bsdf/rough_surface.h"

namespace mlt {
namespace {

class RoughPlastic final : public Bsdf {
 public:
  explicit RoughPlastic(Params& params)
      : eta_(relative_ior_param(params)),
        microfacet_(microfacet_of(params)),
        coating_(microfacet_.type(), microfacet_.alpha_u(), eta_),
        base_(params, eta_, coating_.internal_reflectance(), coating_.mean_transmittance()) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    const Vec3 h = normalize(wl + wc);
    const double D = microfacet_.D(h);
    const Masking light(microfacet_, wl, h), camera(microfacet_, wc, h);
    const RoughFresnel coat_l = coating_.at(wl.z), coat_c = coating_.at(wc.z);
    const double pl = specular_share(coat_l), pc = specular_share(coat_c);
    return {
        specular_part(at, wl, wc, h, D * light.fit * camera.fit) + diffuse_part(at, coat_l, coat_c),
        pl * reflection_pdf(microfacet_, wl, h, D, light.exact) + (1 - pl) * inv_pi * wc.z,
        pc * reflection_pdf(microfacet_, wc, h, D, camera.exact) + (1 - pc) * inv_pi * wl.z};
  }

  std::optional<BsdfSample> sample(const SurfacePoint&, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z <= 0) return std::nullopt;
    if (u.x >= specular_share(coating_.at(from.z))) {
      const Vec3 to = sample_cosine_hemisphere(direction_part(u));
      if (to.z <= 0) return std::nullopt;
      return BsdfSample{to, Lobe::smooth};
    }
    const Vec3 h = microfacet_.sample(from, direction_part(u));
    const Vec3 to = reflect(from, h);
    if (dot(from, h) <= 0 || to.z <= 0) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
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
    const Vec3 h = normalize(wl + wc);
    const Spectrum specular =
        specular_part(at, wl, wc, h, microfacet_.D(h) * microfacet_.G(wl, wc, h));
    const Spectrum diffuse = diffuse_part(at, coating_.at(wl.z), coating_.at(wc.z));
    return target_luminance(specular) > target_luminance(diffuse) ? microfacet_.alpha_u()
                                                                  : infinity;
  }

  double least_roughness() const override { return microfacet_.alpha_u(); }

  Spectrum albedo(const SurfacePoint& at) const override { return base_.albedo(at); }

 private:
  static Microfacet microfacet_of(Params& params) {
    const double alpha = params.real_in("alpha", 0, 10);
    return {microfacet_type_param(params), alpha, alpha, params.boolean("sample_visible")};
  }

  Spectrum specular_part(const SurfacePoint& at, const Vec3& wl, const Vec3& wc, const Vec3& h,
                         double DG) const {
    const double F = fresnel_dielectric(dot(wl, h), eta_).reflectance;
    return F * DG / (4 * wl.z * wc.z) * base_.specular(at);
  }

  Spectrum diffuse_part(const SurfacePoint& at, const RoughFresnel& light,
                        const RoughFresnel& camera) const {
    return light.transmittance * camera.transmittance * base_.eval(at);
  }

  double specular_share(const RoughFresnel& coat) const {
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
      concat({ior_parameters("polypropylene"),
              {microfacet_type_parameter(),
               {"alpha", ParamType::real, 0.1,
                "Roughness: about the root mean square slope of the microfacets."},
               sample_visible_parameter()},
              CoatedBase::parameters()}));
}

}  // namespace mlt
