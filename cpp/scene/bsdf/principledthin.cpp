// Mitsuba 3's principled material for thin sheets, after Burley 2015: light that is refracted
// through both sides leaves as if mirrored, then turned to the other side, with a roughness that
// depends on the index of refraction. Directions are first turned so that light comes from above.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/principled_terms.h"
#include "scene/bsdf/rough_surface.h"
#include "scene/texture/scalar_texture.h"

namespace mlt {
namespace {

class PrincipledThin final : public Bsdf {
  enum ThinLobe : size_t { mirrored, through, diffuse, diffuse_through, lobe_count };

 public:
  explicit PrincipledThin(Params& params)
      : base_color_(texture_param(params, "base_color")),
        roughness_(scalar_param(params, "roughness")),
        anisotropic_(scalar_param(params, "anisotropic")),
        spec_trans_(scalar_param(params, "spec_trans")),
        eta_(unbounded_texture_param(params, "eta")),
        spec_tint_(scalar_param(params, "spec_tint")),
        sheen_(scalar_param(params, "sheen")),
        sheen_tint_(scalar_param(params, "sheen_tint")),
        flatness_(scalar_param(params, "flatness")),
        diff_trans_(unbounded_texture_param(params, "diff_trans")),
        rate_{params.real_in("specular_reflectance_sampling_rate", 0, 1e6),
              params.real_in("specular_transmittance_sampling_rate", 0, 1e6),
              params.real_in("diffuse_reflectance_sampling_rate", 0, 1e6),
              params.real_in("diffuse_transmittance_sampling_rate", 0, 1e6)} {
    if (!(min_component(eta_->mean()) > 0)) params.fail("eta", "must be positive");
    if (max_component(diff_trans_->maximum()) > 2) params.fail("diff_trans", "must not exceed 2");
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth || wl.z * wc.z == 0) return {};
    const Point p = point(at);
    const Parts parts = values(p, at, wl, wc);
    return {parts.diffuse + parts.specular, sum(densities(p, wl, wc)), sum(densities(p, wc, wl))};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    const Point p = point(at);
    double rest = u.x;
    const size_t chosen = p.shares.choose(rest);
    if (from.z == 0 || chosen == lobe_count) return std::nullopt;
    Vec3 to;
    if (chosen == mirrored || chosen == through) {
      const Vec3 wi = upwards(from);
      to = reflect(wi, p.microfacet(chosen == through).sample(wi, direction_part(u)));
      if (chosen == through) to.z = -to.z;
    } else {
      to = sample_cosine_hemisphere(direction_part(u));
      if (chosen == diffuse_through) to = -to;
    }
    const bool reflects = chosen == mirrored || chosen == diffuse;
    if (!(reflects ? to.z > 0 : to.z < 0)) return std::nullopt;
    return BsdfSample{from.z < 0 ? -to : to, Lobe::smooth};
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::smooth || from.z * to.z == 0) return std::nullopt;
    const Point p = point(at);
    const Densities d = densities(p, from, to);
    if (!(sum(d) > 0)) return std::nullopt;
    double rest = v.x;
    const size_t guess = LobeShares<lobe_count>::guess(d, rest);
    const Vec3 wi = upwards(from), wo = from.z < 0 ? -to : to;
    const double x = p.shares.invert(guess, rest);
    if (guess == diffuse) return u_of(x, invert_cosine_hemisphere(wo));
    if (guess == diffuse_through) return u_of(x, invert_cosine_hemisphere(-wo));
    return u_of(x, p.microfacet(guess == through).invert(wi, half(wi, wo)));
  }

  bool has_transmission() const override { return true; }
  /// The roughness of the lobe that scatters more between these directions.
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    if (wl.z * wc.z == 0) return infinity;
    const Point p = point(at);
    const Parts parts = values(p, at, wl, wc);
    if (!(target_luminance(parts.specular) > target_luminance(parts.diffuse))) return infinity;
    const Microfacet microfacet = p.microfacet(!same_side(wl, wc));
    return std::min(microfacet.alpha_u(), microfacet.alpha_v());
  }
  Spectrum albedo(const SurfacePoint& at) const override { return base_color_->eval(at); }

 private:
  /// The parameters at one point that values and densities share.
  struct Point {
    double roughness, anisotropic, spec_trans, eta;
    double diff_trans;  ///< The share of the diffuse light that is transmitted.
    LobeShares<lobe_count> shares;

    /// The microfacets for light that is refracted twice (Burley 2015, fig. 15), or mirrored.
    Microfacet microfacet(bool refracted) const {
      return Microfacet(principled_microfacet(
          refracted ? (0.65 * eta - 0.35) * roughness : roughness, anisotropic));
    }
  };
  Point point(const SurfacePoint& at) const {
    const double s = spec_trans_.eval(at), t = 0.5 * diff_trans_->eval_scalar(at);
    return {roughness_.eval(at),
            anisotropic_.eval(at),
            s,
            eta_->eval_scalar(at),
            t,
            LobeShares<lobe_count>({0.5 * s * rate_[mirrored], 0.5 * s * rate_[through],
                                    (1 - s) * (1 - t) * rate_[diffuse],
                                    (1 - s) * t * rate_[diffuse_through]})};
  }

  /// The half vector of wi, which is above, and of wo, turned upwards.
  static Vec3 half(const Vec3& wi, const Vec3& wo) {
    return normalize(wi + Vec3(wo.x, wo.y, std::abs(wo.z)));
  }

  struct Parts {
    Spectrum diffuse{0}, specular{0};
  };
  Parts values(const Point& p, const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const {
    const Vec3 wi = upwards(wc), wo = wc.z < 0 ? -wl : wl;  // Mitsuba's names: wi to the camera.
    const Vec3 h = half(wi, wo);
    const bool reflects = wo.z > 0;
    const Spectrum base = base_color_->eval(at);
    Parts parts;
    if (p.spec_trans > 0) {
      const double cos_h = dot(wi, h), F = fresnel_dielectric(cos_h, p.eta).reflectance;
      const Microfacet microfacet = p.microfacet(!reflects);
      const double DG = microfacet.D(h) * microfacet.G(wi, wo, h);
      Tinted factor{1 - F, 0, 0};
      if (reflects) {
        const double tint = spec_tint_.eval(at);
        factor = tint * schlick_tinted(schlick_weight(cos_h, p.eta), p.eta);
        factor.white += (1 - tint) * F;
      }
      parts.specular =
          color_of(p.spec_trans * DG / (4 * std::abs(wi.z * wo.z)) * factor, base, tint_of(base));
    }
    if (!reflects) {
      parts.diffuse = (1 - p.spec_trans) * p.diff_trans * inv_pi * base;
      return parts;
    }
    const double cos_d = dot(h, wo);
    Tinted diffuse = principled_sheen(cos_d, sheen_.eval(at), sheen_tint_.eval(at));
    diffuse.base += inv_pi * principled_diffuse(wi.z, wo.z, cos_d, p.roughness, flatness_.eval(at));
    parts.diffuse =
        color_of((1 - p.spec_trans) * (1 - p.diff_trans) * diffuse, base, tint_of(base));
    return parts;
  }

  using Densities = std::array<double, lobe_count>;
  static double sum(const Densities& d) {
    return d[mirrored] + d[through] + d[diffuse] + d[diffuse_through];
  }
  /// The densities of `to`, lobe by lobe.
  static Densities densities(const Point& p, const Vec3& from, const Vec3& to) {
    const bool reflects = same_side(from, to);
    const ThinLobe specular_lobe = reflects ? mirrored : through;
    const ThinLobe diffuse_lobe = reflects ? diffuse : diffuse_through;
    Densities d{};
    d[diffuse_lobe] = p.shares.share[diffuse_lobe] * std::abs(to.z) * inv_pi;
    if (!(p.shares.share[specular_lobe] > 0)) return d;
    const Vec3 wi = upwards(from), h = half(wi, from.z < 0 ? -to : to);
    const Microfacet microfacet = p.microfacet(!reflects);
    d[specular_lobe] = p.shares.share[specular_lobe] *
                       reflection_pdf(microfacet, wi, h, microfacet.D(h), microfacet.g1(wi, h));
    return d;
  }

  TexturePtr base_color_;
  ScalarTexture roughness_, anisotropic_, spec_trans_;
  TexturePtr eta_;
  ScalarTexture spec_tint_, sheen_, sheen_tint_, flatness_;
  TexturePtr diff_trans_;
  double rate_[lobe_count];
};

std::vector<Parameter> thin_parameters() {
  return {
      {"base_color", ParamType::texture, 0.5, "Colour of the material."},
      {"roughness", ParamType::texture, 0.5, "Roughness of the glossy lobes; alpha is its square."},
      {"anisotropic", ParamType::texture, 0.0, "How much the glossy lobes are stretched along u."},
      {"spec_trans", ParamType::texture, 0.0, "Between diffuse (0) and glossy (1)."},
      {"eta", ParamType::texture, 1.5, "Index of refraction inside over outside."},
      {"spec_tint", ParamType::texture, 0.0, "How much the base tints the reflection."},
      {"sheen", ParamType::texture, 0.0, "Of a layer that brightens grazing angles, as on cloth."},
      {"sheen_tint", ParamType::texture, 0.0, "How much the base tints the sheen."},
      {"flatness", ParamType::texture, 0.0, "Between diffuse (0) and subsurface-like (1)."},
      {"diff_trans", ParamType::texture, 0.0,
       "Between diffuse reflection alone (0) and diffuse transmission alone (2)."},
      {"specular_reflectance_sampling_rate", ParamType::real, 1.0, "How often it is sampled."},
      {"specular_transmittance_sampling_rate", ParamType::real, 1.0, "How often it is sampled."},
      {"diffuse_reflectance_sampling_rate", ParamType::real, 1.0, "How often it is sampled."},
      {"diffuse_transmittance_sampling_rate", ParamType::real, 1.0, "How often it is sampled."}};
}

}  // namespace

Plugin bsdf_principledthin() {
  Plugin plugin = make_plugin<PrincipledThin>(
      "bsdf", "principledthin",
      "A thin sheet for many purposes (Burley 2015): leaves, paper, bubbles.", thin_parameters());
  plugin.schema.conserves_energy = false;
  plugin.schema.reciprocal = false;
  return plugin;
}

}  // namespace mlt
