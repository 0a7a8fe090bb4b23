// Mitsuba 3's principled material, after Burley 2012 and 2015: a Lambertian base with sheen, a GGX
// lobe that is metallic or dielectric, refraction through it, and a clear coat.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf/eight_points.h"
#include "scene/bsdf/glass_facet.h"
#include "scene/bsdf/principled_parameters.h"
#include "scene/bsdf/principled_terms.h"

namespace mlt {
namespace {

class Principled final : public Bsdf {
  enum PrincipledLobe : size_t { diffuse, clearcoat, specular, lobe_count };

 public:
  explicit Principled(Params& params)
      : base_color_(texture_param(params, "base_color")),
        roughness_(scalar_param(params, "roughness")),
        anisotropic_(scalar_param(params, "anisotropic")),
        metallic_(scalar_param(params, "metallic")),
        spec_trans_(scalar_param(params, "spec_trans")),
        spec_tint_(scalar_param(params, "spec_tint")),
        sheen_(scalar_param(params, "sheen")),
        sheen_tint_(scalar_param(params, "sheen_tint")),
        flatness_(scalar_param(params, "flatness")),
        clearcoat_(scalar_param(params, "clearcoat")),
        clearcoat_gloss_(scalar_param(params, "clearcoat_gloss")),
        diffuse_rate_(params.real_in("diffuse_reflectance_sampling_rate", 0, 1e6)),
        specular_rate_(params.real_in("main_specular_sampling_rate", 0, 1e6)),
        clearcoat_rate_(params.real_in("clearcoat_sampling_rate", 0, 1e6)),
        refracts_(!spec_trans_.vanishes()),
        coated_(!clearcoat_.vanishes()) {
    eta_ = principled_eta(params, refracts_);
    const double alpha = sqr(roughness_.mean());
    const double coat = coated_ ? ClearCoat<double>::alpha(clearcoat_gloss_.mean()) : infinity;
    supports_lanes_ = !refracts_ && std::min(alpha, coat) >= least_alpha_in_lanes;
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth) return {};
    const Point<double> p = point(at);
    if (above(wl, wc)) {
      const Terms<double> t = terms(p, wl, wc);
      return {value(colors(at), t), t.pdf_from_light, t.pdf_from_camera};
    }
    const GlassFacet facet = facet_of_glass(wl, wc);
    if (!facet.exists) return {};
    return {glass(p, at, wl, wc, facet), glass_pdf(p, wl, wc, facet), glass_pdf(p, wc, wl, facet)};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    const Point<double> p = point(at);
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

  void scatter(ScatteringLanes& x) const override { scatter_by_eight(*this, x); }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (lobe != Lobe::smooth) return std::nullopt;
    const Point<double> p = point(at);
    if (!above(from, to)) return invert_glass(p, from, to, v.x);
    const MicrofacetReflection mirror(p.microfacet, from, to);
    const Vec3& h = mirror.h;
    const double fresnel = reflectance(dot(from, h));
    const Densities<double> d = densities(p, from, to, h, fresnel, mirror.pdf_from_light);
    if (!(sum(d) > 0)) return std::nullopt;
    double rest = v.x;
    const size_t guess = LobeShares<lobe_count>::guess(d, rest);
    const LobeShares<lobe_count> chosen = shares_above(p);
    if (guess == diffuse) return u_of(chosen.invert(diffuse, rest), invert_cosine_hemisphere(to));
    if (guess == clearcoat) return u_of(chosen.invert(clearcoat, rest), p.coat.invert(h));
    return u_of(chosen.invert(specular, u_of_first(reflected_above(p, fresnel), rest)),
                Microfacet(p.microfacet).invert(from, h));
  }

  bool has_transmission() const override { return refracts_; }
  double relative_eta(const SurfacePoint&, const Vec3& w) const override {
    return refracts_ ? eta_on_side(eta_, w) : 1;
  }
  /// The roughness of the lobe that scatters most between these directions.
  double roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const override {
    const Point<double> p = point(at);
    const double alpha = std::min(p.microfacet.alpha_u, p.microfacet.alpha_v);
    if (!above(wl, wc)) {
      const GlassFacet facet = facet_of_glass(wl, wc);
      const bool scatters = facet.exists && target_luminance(glass(p, at, wl, wc, facet)) > 0;
      return scatters ? alpha : infinity;
    }
    const Terms<double> t = terms(p, wl, wc);
    const auto [base, hue] = colors(at);
    const double d = target_luminance(color_of(t.diffuse, base, hue)),
                 s = target_luminance(color_of(t.specular, base, hue)), c = t.clearcoat;
    if (s >= std::max(c, d) && s > 0) return alpha;
    return c > d ? std::sqrt(p.coat.alpha2) : infinity;
  }
  Spectrum albedo(const SurfacePoint& at) const override { return base_color_->eval(at); }

  // The model of eight_points.h:

  template <class F>
  using Point = PrincipledPoint<F>;
  template <class F>
  Point<F> point(const SurfacePoint* const* at) const {
    const F roughness = roughness_.eval<F>(at), metallic = metallic_.eval<F>(at),
            spec_trans = spec_trans_.eval<F>(at);
    return {roughness,
            metallic,
            spec_tint_.eval<F>(at),
            sheen_.eval<F>(at),
            sheen_tint_.eval<F>(at),
            flatness_.eval<F>(at),
            clearcoat_.eval<F>(at),
            (1 - metallic) * (1 - spec_trans),
            (1 - metallic) * spec_trans,
            principled_microfacet(roughness, anisotropic_.eval<F>(at)),
            coated_ ? ClearCoat<F>::of_gloss(clearcoat_gloss_.eval<F>(at)) : ClearCoat<F>{}};
  }
  template <class F>
  F narrowest(const Point<F>& p) const {
    const F alpha = min(p.microfacet.alpha_u, p.microfacet.alpha_v);
    return coated_ ? min(alpha, sqrt(p.coat.alpha2)) : alpha;
  }

  template <class F>
  using Terms = PrincipledTerms<F>;
  template <class F>
  Terms<F> terms(const Point<F>& p, const Vec3Of<F>& wl, const Vec3Of<F>& wc) const {
    const MicrofacetReflection mirror(p.microfacet, wl, wc);
    const Vec3Of<F>& h = mirror.h;
    const F cos_h = dot(wl, h), w = schlick_weight(cos_h, eta_), fresnel = reflectance(cos_h);
    const F dielectric = 1 - p.metallic;
    TintedOf<F> diffuse = dielectric * principled_sheen(cos_h, p.sheen, p.sheen_tint);
    diffuse.base +=
        p.brdf * number<F>(inv_pi) * principled_diffuse(wl.z, wc.z, cos_h, p.roughness, p.flatness);
    TintedOf<F> specular = p.metallic * schlick_metal(w);
    specular += (dielectric * p.spec_tint) * schlick_tinted(w, eta_);
    specular.white += dielectric * (1 - p.spec_tint) * fresnel;
    const F factor = select(fresnel > 0, mirror.DG / (4 * wl.z * wc.z), F(0));
    F coat(0);
    if (coated_)
      coat = number<F>(0.25) * p.clearcoat * ClearCoat<F>::fresnel(cos_h, eta_) * p.coat.D(h) *
             ClearCoat<F>::G(wl, wc, h);
    return {diffuse, factor * specular, coat,
            sum(densities(p, wl, wc, h, fresnel, mirror.pdf_from_light)),
            sum(densities(p, wc, wl, h, fresnel, mirror.pdf_from_camera))};
  }

  Vec3Of<Float8> direction(const Point<Float8>& p, const Vec3Of<Float8>& from,
                           const Vec3Of<Float8>& u) const {
    const auto chosen = shares_above(p);
    const Float8 first = chosen.share[diffuse];
    const Vec2Of<Float8> v(u.y, u.z);
    Vec3Of<Float8> to = mirrored(from, p.microfacet.sample(from, v));
    if (coated_)
      to = select(u.x < first + chosen.share[clearcoat], mirrored(from, p.coat.sample(v)), to);
    return select(u.x < first, sample_cosine_hemisphere(v), to);
  }

  struct Colors {
    Spectrum base, hue;
  };
  Colors colors(const SurfacePoint& at) const {
    const Spectrum base = base_color_->eval(at);
    return {base, tint_of(base)};
  }
  static Spectrum value(const Colors& colors, const Terms<double>& terms) {
    Tinted sum = terms.diffuse;
    sum += terms.specular;
    sum.white += terms.clearcoat;
    return color_of(sum, colors.base, colors.hue);
  }

 private:
  Point<double> point(const SurfacePoint& at) const {
    const SurfacePoint* one = &at;
    return point<double>(&one);
  }

  /// Fresnel's reflectance for light from above.
  template <class F>
  F reflectance(F cosine) const {
    return eta_ == 1 ? F(0) : dielectric_reflectance(cosine, eta_);
  }

  /// The densities of one direction, lobe by lobe.
  template <class F>
  using Densities = std::array<F, lobe_count>;
  template <class F>
  static F sum(const Densities<F>& d) {
    return d[diffuse] + d[clearcoat] + d[specular];
  }
  /// The densities of `to`; both directions are above the surface. `mirrored` is that of the main
  /// lobe alone.
  template <class F>
  Densities<F> densities(const Point<F>& p, const Vec3Of<F>& from, const Vec3Of<F>& to,
                         const Vec3Of<F>& h, F fresnel, F mirrored) const {
    const auto chosen = shares_above(p);
    return {chosen.share[diffuse] * number<F>(inv_pi) * to.z,
            coated_ ? chosen.share[clearcoat] * p.coat.D(h) * h.z / (4 * abs(dot(from, h))) : F(0),
            chosen.share[specular] * reflected_above(p, fresnel) * mirrored};
  }

  /// The probabilities of the lobes, as in Mitsuba.
  template <class F>
  LobeShares<lobe_count, F> shares_above(const Point<F>& p) const {
    return LobeShares<lobe_count, F>({p.brdf * number<F>(diffuse_rate_),
                                      p.clearcoat * number<F>(0.25 * clearcoat_rate_),
                                      number<F>(specular_rate_)});
  }
  /// From below there are only microfacets.
  LobeShares<lobe_count> shares(const Point<double>& p, const Vec3& from) const {
    if (from.z < 0) return LobeShares<lobe_count>({0, 0, p.bsdf > 0 ? 1.0 : 0.0});
    return shares_above(p);
  }
  /// The probability that a sampled microfacet reflects.
  template <class F>
  static F reflected_above(const Point<F>& p, F fresnel) {
    return 1 - p.bsdf * (1 - fresnel);
  }
  static double reflected_share(const Point<double>& p, const Vec3& from, double fresnel) {
    return from.z < 0 ? fresnel : reflected_above(p, fresnel);
  }

  // Where one direction is not above the surface there are only the microfacets of glass.

  GlassFacet facet_of_glass(const Vec3& a, const Vec3& b) const {
    return refracts_ ? glass_facet(a, b, eta_) : GlassFacet{};
  }
  Spectrum glass(const Point<double>& p, const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                 const GlassFacet& facet) const {
    const double F = facet.F, cosines = std::abs(wl.z * wc.z);
    const double DG =
        p.microfacet.D(facet.h) * p.microfacet.g1(wl, facet.h) * p.microfacet.g1(wc, facet.h);
    if (facet.reflects) return Spectrum(p.bsdf * F * DG / (4 * cosines));
    const double jacobian = refraction_jacobian(facet, wl, wc);
    return sqrt(base_color_->eval(at)) * (p.bsdf * (1 - F) * DG * jacobian / cosines);
  }
  double glass_pdf(const Point<double>& p, const Vec3& from, const Vec3& to,
                   const GlassFacet& facet) const {
    const double D = p.microfacet.D(facet.h), g1 = p.microfacet.g1(from, facet.h);
    const double reflected = reflected_share(p, from, facet.F);
    return shares(p, from).share[specular] * (facet.reflects ? reflected : 1 - reflected) *
           facet_pdf(p.microfacet, from, to, facet, D, g1);
  }

  static std::optional<BsdfSample> usable(const Vec3& from, const Vec3& to, bool reflects) {
    if (to.z == 0 || same_side(from, to) != reflects) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }
  std::optional<Vec3> invert_glass(const Point<double>& p, const Vec3& from, const Vec3& to,
                                   double v) const {
    const GlassFacet facet = facet_of_glass(from, to);
    if (!facet.exists || !(glass_pdf(p, from, to, facet) > 0)) return std::nullopt;
    const double reflected = reflected_share(p, from, facet.F);
    const double u = facet.reflects ? u_of_first(reflected, v) : u_of_second(reflected, v);
    return u_of(shares(p, from).invert(specular, u),
                Microfacet(p.microfacet).invert(upwards(from), facet.h));
  }

  TexturePtr base_color_;
  ScalarTexture roughness_, anisotropic_, metallic_, spec_trans_, spec_tint_, sheen_, sheen_tint_,
      flatness_, clearcoat_, clearcoat_gloss_;
  double diffuse_rate_, specular_rate_, clearcoat_rate_;
  bool refracts_, coated_;
  double eta_;
};

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
