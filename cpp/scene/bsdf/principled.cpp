// Mitsuba 3's principled material, after Burley 2012 and 2015: a Lambertian base with sheen, a GGX
// lobe that is metallic or dielectric, refraction through it, and a clear coat.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf.h"
#include "scene/bsdf/principled_terms.h"
#include "scene/bsdf/rough_surface.h"

namespace mlt {
namespace {

class Principled final : public Bsdf {
  enum PrincipledLobe : size_t { diffuse, clearcoat, specular, lobe_count };

 public:
  explicit Principled(Params& params)
      : base_color_(texture_param(params, "base_color")),
        roughness_(texture_param(params, "roughness")),
        anisotropic_(texture_param(params, "anisotropic")),
        metallic_(texture_param(params, "metallic")),
        spec_trans_(texture_param(params, "spec_trans")),
        spec_tint_(texture_param(params, "spec_tint")),
        sheen_(texture_param(params, "sheen")),
        sheen_tint_(texture_param(params, "sheen_tint")),
        flatness_(texture_param(params, "flatness")),
        clearcoat_(texture_param(params, "clearcoat")),
        clearcoat_gloss_(texture_param(params, "clearcoat_gloss")),
        diffuse_rate_(params.real_in("diffuse_reflectance_sampling_rate", 0, 1e6)),
        specular_rate_(params.real_in("main_specular_sampling_rate", 0, 1e6)),
        clearcoat_rate_(params.real_in("clearcoat_sampling_rate", 0, 1e6)),
        refracts_(max_component(spec_trans_->maximum()) > 0) {
    if (params.has("eta") && params.has("specular"))
      params.fail("eta", "and 'specular' exclude each other");
    if (params.has("eta")) {
      eta_ = params.real_in("eta", 1e-3, 1e3);
    } else {
      // Burley 2015, sec. 3: R0 = 0.08 specular.
      const double least = refracts_ ? 1e-3 : 0;
      const double r = std::sqrt(0.08 * std::max(params.real_in("specular", 0, 1), least));
      eta_ = 2 / (1 - r) - 1;
    }
    if (refracts_ && eta_ == 1) eta_ = 1.001;
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    const Half half = half_between(wl, wc, lobe);
    if (!half.exists) return {};
    const Point p = point(at);
    const Parts parts = values(p, at, wl, wc, half);
    return {parts.diffuse + parts.clearcoat + parts.specular, sum(densities(p, wl, wc, half)),
            sum(densities(p, wc, wl, half))};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    const Point p = point(at);
    double rest = u.x;
    const size_t chosen = shares(p, from).choose(rest);
    if (from.z == 0 || chosen == lobe_count) return std::nullopt;
    const Vec2 v = direction_part(u);
    if (chosen == diffuse) return usable(from, sample_cosine_hemisphere(v), true);
    const Vec3 h = chosen == clearcoat ? p.coat.sample(v) : p.microfacet.sample(upwards(from), v);
    const double cos_h = dot(from, h);
    if (!(cos_h * from.z > 0)) return std::nullopt;
    if (chosen == clearcoat) return usable(from, reflect(from, h), true);
    const Fresnel F = fresnel_dielectric(cos_h, eta_);
    const bool reflects = rest < reflected_share(p, from, F.reflectance);
    if (!reflects && F.cos_t == 0) return std::nullopt;
    return usable(from, reflects ? reflect(from, h) : refract(from, h, F.cos_t, F.eta_ti),
                  reflects);
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    const Half half = half_between(from, to, lobe);
    if (!half.exists) return std::nullopt;
    const Point p = point(at);
    const Densities d = densities(p, from, to, half);
    if (!(sum(d) > 0)) return std::nullopt;
    double rest = v.x;
    const size_t guess = LobeShares<lobe_count>::guess(d, rest);
    const LobeShares<lobe_count> chosen = shares(p, from);
    if (guess == diffuse) return u_of(chosen.invert(diffuse, rest), invert_cosine_hemisphere(to));
    if (guess == clearcoat) return u_of(chosen.invert(clearcoat, rest), p.coat.invert(half.h));
    const double reflected = reflected_share(p, from, half.F);
    const double u = half.reflects ? u_of_first(reflected, rest) : u_of_second(reflected, rest);
    return u_of(chosen.invert(specular, u), p.microfacet.invert(upwards(from), half.h));
  }

  bool has_transmission() const override { return refracts_; }
  double relative_eta(const SurfacePoint&, const Vec3& w) const override {
    return refracts_ ? eta_on_side(w) : 1;
  }
  /// The roughness of the lobe that scatters most between these directions.
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    const Half half = half_between(wl, wc, Lobe::smooth);
    if (!half.exists) return infinity;
    const Point p = point(at);
    const Parts parts = values(p, at, wl, wc, half);
    const double d = target_luminance(parts.diffuse), c = target_luminance(parts.clearcoat),
                 s = target_luminance(parts.specular);
    if (s >= std::max(c, d) && s > 0)
      return std::min(p.microfacet.alpha_u(), p.microfacet.alpha_v());
    return c > d ? std::sqrt(p.coat.alpha2) : infinity;
  }
  Spectrum albedo(const SurfacePoint& at) const override { return base_color_->eval(at); }

 private:
  /// The parameters at one point that values and densities share.
  struct Point {
    double roughness, metallic, clearcoat, clearcoat_gloss;
    double brdf, bsdf;  ///< Shares of the opaque and of the refracting dielectric.
    Microfacet microfacet;
    ClearCoat coat;
  };
  Point point(const SurfacePoint& at) const {
    const double roughness = roughness_->eval_scalar(at), metallic = metallic_->eval_scalar(at);
    const double spec_trans = spec_trans_->eval_scalar(at),
                 gloss = clearcoat_gloss_->eval_scalar(at);
    return {roughness,
            metallic,
            clearcoat_->eval_scalar(at),
            gloss,
            (1 - metallic) * (1 - spec_trans),
            (1 - metallic) * spec_trans,
            principled_microfacet(roughness, anisotropic_->eval_scalar(at)),
            ClearCoat(gloss)};
  }

  /// The microfacet that scatters between two directions; the same in either order, bit for bit.
  struct Half {
    bool exists, reflects;
    bool microfacet;  ///< Whether each direction is on the same side of h as of the surface.
    Vec3 h;           ///< Above the surface.
    double F;
  };
  Half half_between(const Vec3& a, const Vec3& b, Lobe lobe) const {
    if (lobe != Lobe::smooth || a.z * b.z == 0) return {};
    const bool reflects = same_side(a, b);
    if (!reflects && !refracts_) return {};
    if (reflects && a.z < 0 && !refracts_) return {};
    const Vec3 sum = reflects ? a + b : a.z > 0 ? a + eta_ * b : b + eta_ * a;
    if (sum.z == 0) return {};
    const Vec3 h = normalize(sum.z < 0 ? -sum : sum);
    const double cos_a = dot(a, h), cos_b = dot(b, h);
    const bool microfacet = cos_a * a.z > 0 && cos_b * b.z > 0;
    const bool thin_is_above = eta_ > 1;
    const double cosine = reflects ? 0.5 * dot(sum, h) : (a.z > 0) == thin_is_above ? cos_a : cos_b;
    return {true, reflects, microfacet, h, fresnel_dielectric(cosine, eta_).reflectance};
  }

  struct Parts {
    Spectrum diffuse{0}, clearcoat{0}, specular{0};
  };
  Parts values(const Point& p, const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
               const Half& half) const {
    const Spectrum base = base_color_->eval(at);
    Parts parts;
    if (half.microfacet) parts.specular = specular_part(p, at, base, wl, wc, half);
    if (!half.reflects || wl.z < 0) return parts;
    const double cos_h = dot(wl, half.h);
    if (half.microfacet && p.clearcoat > 0)
      parts.clearcoat = Spectrum(0.25 * p.clearcoat * ClearCoat::fresnel(cos_h, eta_) *
                                 p.coat.D(half.h) * ClearCoat::G(wl, wc, half.h));
    if (p.brdf > 0)
      parts.diffuse =
          base * (p.brdf * inv_pi *
                  principled_diffuse(wl.z, wc.z, cos_h, p.roughness, flatness_->eval_scalar(at)));
    if (p.metallic < 1)
      parts.diffuse += sheen_->eval_scalar(at) * (1 - p.metallic) *
                       schlick_weight(std::abs(cos_h)) * tinted(base, sheen_tint_->eval_scalar(at));
    return parts;
  }

  Spectrum specular_part(const Point& p, const SurfacePoint& at, const Spectrum& base,
                         const Vec3& wl, const Vec3& wc, const Half& half) const {
    const double DG = p.microfacet.D(half.h) * p.microfacet.G(wl, wc, half.h);
    const double cosines = std::abs(wl.z * wc.z), l = dot(wl, half.h), c = dot(wc, half.h);
    if (!half.reflects) {
      const double jacobian = std::abs(l * c) / sqr(l * eta_on_side(wl) + c);
      return sqrt(base) * (p.bsdf * (1 - half.F) * DG * jacobian / cosines);
    }
    if (!(half.F > 0)) return Spectrum(0);
    if (wl.z < 0) return Spectrum(p.bsdf * half.F * DG / (4 * cosines));
    const double tint = spec_tint_->eval_scalar(at);
    const Spectrum F = Spectrum((1 - p.metallic) * (1 - tint) * half.F) +
                       p.metallic * schlick(base, l, eta_) +
                       (1 - p.metallic) * tint * tinted_schlick(base, l, eta_);
    return F * (DG / (4 * cosines));
  }

  using Densities = std::array<double, lobe_count>;
  static double sum(const Densities& d) { return d[diffuse] + d[clearcoat] + d[specular]; }
  /// The densities of `to`, lobe by lobe.
  Densities densities(const Point& p, const Vec3& from, const Vec3& to, const Half& half) const {
    const LobeShares<lobe_count> chosen = shares(p, from);
    Densities d{};
    if (half.reflects && from.z > 0) d[diffuse] = chosen.share[diffuse] * to.z * inv_pi;
    if (!half.microfacet) return d;
    const double D = p.microfacet.D(half.h), g1 = p.microfacet.g1(from, half.h);
    const double f = dot(from, half.h), t = dot(to, half.h);
    const double reflected = reflected_share(p, from, half.F);
    if (!half.reflects) {
      d[specular] = chosen.share[specular] * (1 - reflected) *
                    normal_pdf(p.microfacet, from, half.h, D, g1) * std::abs(t) /
                    sqr(f * eta_on_side(from) + t);
      return d;
    }
    d[specular] =
        chosen.share[specular] * reflected * reflection_pdf(p.microfacet, from, half.h, D, g1);
    if (from.z > 0)
      d[clearcoat] = chosen.share[clearcoat] * p.coat.D(half.h) * half.h.z / (4 * std::abs(f));
    return d;
  }

  /// The probabilities of the lobes, as in Mitsuba. From below there are only microfacets.
  LobeShares<lobe_count> shares(const Point& p, const Vec3& from) const {
    if (from.z < 0) return LobeShares<lobe_count>({0, 0, p.bsdf > 0 ? 1.0 : 0.0});
    return LobeShares<lobe_count>(
        {p.brdf * diffuse_rate_, 0.25 * p.clearcoat * clearcoat_rate_, specular_rate_});
  }
  /// The probability that a sampled microfacet reflects.
  static double reflected_share(const Point& p, const Vec3& from, double F) {
    return from.z < 0 ? F : 1 - p.bsdf * (1 - F);
  }

  static std::optional<BsdfSample> usable(const Vec3& from, const Vec3& to, bool reflects) {
    if (to.z == 0 || same_side(from, to) != reflects) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }
  double eta_on_side(const Vec3& w) const { return w.z > 0 ? 1 / eta_ : eta_; }

  TexturePtr base_color_, roughness_, anisotropic_, metallic_, spec_trans_, spec_tint_, sheen_,
      sheen_tint_, flatness_, clearcoat_, clearcoat_gloss_;
  double diffuse_rate_, specular_rate_, clearcoat_rate_;
  bool refracts_;
  double eta_;
};

std::vector<Parameter> principled_parameters() {
  return {
      {"base_color", ParamType::texture, 0.5, "Colour of the material."},
      {"roughness", ParamType::texture, 0.5, "Roughness of the main lobe; alpha is its square."},
      {"anisotropic", ParamType::texture, 0.0, "How much the main lobe is stretched along u."},
      {"metallic", ParamType::texture, 0.0, "Between a dielectric (0) and a metal (1)."},
      {"spec_trans", ParamType::texture, 0.0, "Between an opaque (0) and a clear dielectric (1)."},
      {"eta", ParamType::real, no_default, "Index of refraction inside over outside; or specular."},
      {"specular", ParamType::real, 0.5,
       "Reflectance of the dielectric at normal incidence / 0.08."},
      {"spec_tint", ParamType::texture, 0.0, "How much the base tints the dielectric reflection."},
      {"sheen", ParamType::texture, 0.0, "Of a layer that brightens grazing angles, as on cloth."},
      {"sheen_tint", ParamType::texture, 0.0, "How much the base tints the sheen."},
      {"flatness", ParamType::texture, 0.0, "Between diffuse (0) and subsurface-like (1)."},
      {"clearcoat", ParamType::texture, 0.0, "Of a second, isotropic lobe above everything."},
      {"clearcoat_gloss", ParamType::texture, 0.0, "Of the clear coat: 1 is sharpest."},
      {"diffuse_reflectance_sampling_rate", ParamType::real, 1.0, "How often it is sampled."},
      {"main_specular_sampling_rate", ParamType::real, 1.0, "How often it is sampled."},
      {"clearcoat_sampling_rate", ParamType::real, 1.0, "How often it is sampled."}};
}

}  // namespace

Plugin bsdf_principled() {
  Plugin plugin = make_plugin<Principled>("bsdf", "principled",
                                          "A material for many purposes (Burley 2012, 2015): "
                                          "diffuse, metallic, clear, coated, with sheen.",
                                          principled_parameters());
  plugin.schema.conserves_energy = false;
  plugin.schema.reciprocal = false;
  return plugin;
}

}  // namespace mlt
