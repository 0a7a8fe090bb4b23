#include "scene/bsdf/openpbr_reflection.h"

namespace mlt {
namespace {

double openpbr_eta(const OpenPbrTextures& textures, bool opaque) {
  // Light that is refracted leaves the coat in the direction that it has without one.
  const double alone = textures.relative_ior(1);
  if (!opaque) return alone;
  const double coat = textures.coat_weight.mean(), ior = textures.coat_ior;
  if (coat == 0) return alone;
  const double below = textures.relative_ior(ior);
  return alone + coat * (std::max(below, 1 / below) - alone);
}

}  // namespace

OpenPbrReflection::OpenPbrReflection(Params& params, Kind kind)
    : textures_(params),
      thin_(kind == Kind::thin),
      coated_(!textures_.coat_weight.vanishes()),
      fuzzy_(!textures_.fuzz_weight.vanishes()),
      metallic_(!textures_.base_metalness.vanishes()),
      rough_base_(!textures_.base_diffuse_roughness.vanishes()),
      stretched_(!textures_.specular_roughness_anisotropy.vanishes()),
      coat_tints_(textures_.coat_color->mean() != Color(1)) {
  const bool enters = textures_.transmits() || (!thin_ && textures_.has_subsurface());
  transmits_ = enters || (thin_ && textures_.has_subsurface());
  refracts_ = enters && !thin_;
  set_eta(openpbr_eta(textures_, !enters));
  if (coated_) {
    coat_energy_ = InterfaceEnergy::of(textures_.coat_ior);
    coat_mean_fresnel_ = fresnel_diffuse_reflectance(textures_.coat_ior);
  }
  glow_ = openpbr_glow(params);
  base_weight_ = textures_.base_weight.mean() * target_luminance(textures_.base_color->mean());
  metal_weight_ = base_weight_ + (1 - base_weight_) / 21;
  fuzz_weight_ = target_luminance(textures_.fuzz_color->mean());
  const double r = textures_.specular_roughness.mean(), rc = textures_.coat_roughness.mean();
  const double narrowest = sqr(coated_ ? std::min(r, rc) : r);
  supports_lanes_ = !thin_ && !has_transmission() && !film_ && !has_passage() &&
                    narrowest >= least_alpha_in_lanes;
}

void OpenPbrReflection::set_eta(double eta) {
  eta_ = eta == 1 && transmits_ ? 1.001 : eta;
  energy_ = InterfaceEnergy::of(eta_);
  if (textures_.specular_roughness.is_constant() && !coated_) {
    const double r = textures_.specular_roughness.mean();
    gloss_row_.emplace(energy_->reflectance, r);
    gloss_mean_ = energy_->mean.at(r);
  }
  if (refracts_) glass_ = BalancedScales::of_glass(eta_);
  if (!textures_.thin_film_weight.vanishes()) {
    film_.emplace(1000 * textures_.thin_film_thickness, textures_.thin_film_ior, eta_);
    mean_fresnel_ = fresnel_diffuse_reflectance(eta_);
  }
}

template <class F>
OpenPbrPoint<F> OpenPbrReflection::point(const SurfacePoint* const* at) const {
  const OpenPbrTextures& t = textures_;
  const auto get = [&](const ScalarTexture& texture) { return texture.eval<F>(at); };
  Point<F> p;
  p.metalness = get(t.base_metalness);
  const F T = get(t.transmission_weight);
  p.enters = thin_ ? T : T + (1 - T) * get(t.subsurface_weight);
  p.coat = get(t.coat_weight);
  p.fuzz = get(t.fuzz_weight);
  p.gloss = t.gloss<F>(at);
  p.metal = min(F(1), get(t.specular_weight));
  p.diffuse_roughness = get(t.base_diffuse_roughness);
  p.fuzz_roughness = get(t.fuzz_roughness);
  p.roughness = get(t.specular_roughness);
  p.coat_roughness = get(t.coat_roughness);
  if (coated_) {  // "Roughening"
    const F both = sqr(sqr(p.roughness)) + 2 * sqr(sqr(p.coat_roughness));
    p.roughness += p.coat * (sqrt(sqrt(min(F(1), both))) - p.roughness);
    p.coat_facets = openpbr_facets(p.coat_roughness, get(t.coat_roughness_anisotropy));
  }
  p.facets = openpbr_facets(p.roughness, get(t.specular_roughness_anisotropy));
  p.diffuse_scale = diffuse_scale(p);
  return p;
}

template <class F>
F OpenPbrReflection::diffuse_scale(const Point<F>& p) const {
  F left = 1 - p.gloss * (gloss_row_ ? number<F>(gloss_mean_) : energy_->mean.at(p.roughness));
  if (coated_ || fuzzy_) {  // the Gauss-Legendre rule of 2 int_0^1 f(c) c dc
    constexpr std::array<double, 4> node = {0.0694318442, 0.3300094782, 0.6699905218, 0.9305681558};
    constexpr std::array<double, 4> weight = {0.1739274226, 0.3260725774, 0.3260725774,
                                              0.1739274226};
    left = F(0);
    for (size_t i = 0; i < node.size(); ++i) {
      const Vec3Of<F> w(F(0), F(0), number<F>(node[i]));
      left += number<F>(2 * node[i] * weight[i]) * shares(p, w).under_gloss();
    }
  }
  // A rough base sends more of its light along the normal, where more of it comes through.
  return 1 / (left * (1 + number<F>(0.08) * p.diffuse_roughness * (1 - left)));
}

template <class F>
OpenPbrShares<F> OpenPbrReflection::shares(const Point<F>& p, const Vec3Of<F>& w) const {
  return {fuzzy_ ? p.fuzz * fuzz_reflectance().at(w.z, p.fuzz_roughness) : F(0),
          coated_ ? p.coat * coat_energy_->reflectance.at(w.z, p.coat_roughness) : F(0),
          glossy_share(p, w.z)};
}

template <class F>
auto OpenPbrReflection::choice(const Point<F>& p, const OpenPbrShares<F>& s) const
    -> LobeShares<lobe_count, F> {
  const F dielectric = 1 - p.metalness;
  const F reflects = p.metalness * p.metal * number<F>(metal_weight_) +
                     dielectric * (s.gloss + p.enters * (1 - s.gloss));
  return LobeShares<lobe_count, F>(
      {s.under_gloss() * dielectric * (1 - p.enters) * number<F>(base_weight_),
       s.under_coat() * reflects, s.under_fuzz() * s.coat, s.fuzz * number<F>(fuzz_weight_)});
}

template <class F>
OpenPbrTerms<F> OpenPbrReflection::terms(const Point<F>& p, const Vec3Of<F>& wl,
                                         const Vec3Of<F>& wc) const {
  const OpenPbrShares<F> l = shares(p, wl), c = shares(p, wc);
  const F dielectric = 1 - p.metalness, over_cosines = 1 / (4 * wl.z * wc.z);
  const auto light = choice(p, l), camera = choice(p, c);
  Terms<F> t{};
  t.cos_l = wl.z;
  t.cos_c = wc.z;

  RoughDiffuseTerms<F> base{number<F>(inv_pi), F(0)};
  if (rough_base_) base = EnergyPreservingOrenNayar<F>(p.diffuse_roughness).eval(wl, wc);
  const F diffused =
      dielectric * (1 - p.enters) * l.under_gloss() * c.under_gloss() * p.diffuse_scale;
  t.diffuse_once = diffused * base.once;
  t.diffuse_twice = diffused * base.twice;

  const MicrofacetReflection<F> mirror(p.facets, wl, wc);
  t.cos_h = dot(wl, mirror.h);
  t.fresnel = reflectance(t.cos_h);
  const F facets = mirror.DG * over_cosines * min(l.under_coat(), c.under_coat());
  t.gloss = dielectric * p.gloss * facets;
  if (glass_ || (thin_ && transmits_)) {
    const EnergyTable& scales = glass_ ? glass_->above : BalancedScales::of_mirrors().above;
    const F scaled = scale(scales, p, wl) * scale(scales, p, wc);
    t.gloss *= 1 + p.enters * (scaled - 1);
  }
  t.angle = MetalAngle<F>(t.cos_h);
  if (metallic_) {
    const EnergyTable& mirrors = BalancedScales::of_mirrors().above;
    t.metal = p.metalness * p.metal * facets;
    t.metal_again = scale(mirrors, p, wl) * scale(mirrors, p, wc) - 1;
  }
  const F reflected = reflected_share(p, t.fresnel);
  t.pdf_from_light = light.share[diffuse] * number<F>(inv_pi) * wc.z +
                     light.share[specular] * reflected * mirror.pdf_from_light;
  t.pdf_from_camera = camera.share[diffuse] * number<F>(inv_pi) * wl.z +
                      camera.share[specular] * reflected * mirror.pdf_from_camera;
  if (coated_) {
    const MicrofacetReflection<F> top(p.coat_facets, wl, wc);
    const double eta = textures_.coat_ior;
    const F F_coat = eta == 1 ? F(0) : dielectric_reflectance(dot(wl, top.h), eta);
    t.coat = p.coat * F_coat * top.DG * over_cosines * min(l.under_fuzz(), c.under_fuzz());
    const auto inside = [&](F z) {
      return sqrt(max(number<F>(1e-4), 1 - (1 - z * z) * number<F>(1 / sqr(eta))));
    };
    t.coat_path = number<F>(0.5) * (1 / inside(wl.z) + 1 / inside(wc.z));
    t.pdf_from_light += light.share[coat] * top.pdf_from_light;
    t.pdf_from_camera += camera.share[coat] * top.pdf_from_camera;
  }
  if (fuzzy_) {
    const FuzzLobe<F> of_l(wl, p.fuzz_roughness), of_c(wc, p.fuzz_roughness);
    t.fuzz = p.fuzz * fuzz_brdf(of_l, of_c, wl, wc);
    t.pdf_from_light += light.share[fuzz] * of_l.density(wc);
    t.pdf_from_camera += camera.share[fuzz] * of_c.density(wl);
  }
  return t;
}

template <class F>
Vec3Of<F> OpenPbrReflection::direction(const Point<F>& p, const Vec3Of<F>& from,
                                       const Vec3Of<F>& u) const {
  const auto chosen = choice(p, shares(p, from));
  const Vec2Of<F> v(u.y, u.z);
  F below = chosen.share[diffuse] + chosen.share[specular];
  Vec3Of<F> to = mirrored(p.facets, from, v);
  to = select(u.x < chosen.share[diffuse], sample_cosine_hemisphere(v), to);
  if (coated_) {
    to = select(u.x < below, to, mirrored(p.coat_facets, from, v));
    below += chosen.share[coat];
  }
  if (fuzzy_) to = select(u.x < below, to, FuzzLobe<F>(from, p.fuzz_roughness).sample(v));
  return to;
}

void OpenPbrReflection::scatter(ScatteringLanes& x) const { scatter_by_eight(*this, x); }

OpenPbrReflection::Densities OpenPbrReflection::densities(const Point<double>& p, const Vec3& from,
                                                          const Vec3& to, double reflects) const {
  const auto chosen = choice(p, shares(p, from));
  Densities d{};
  d[diffuse] = chosen.share[diffuse] * inv_pi * to.z;
  d[specular] = chosen.share[specular] * reflects *
                MicrofacetReflection<double>(p.facets, from, to).pdf_from_light;
  if (coated_)
    d[coat] =
        chosen.share[coat] * MicrofacetReflection<double>(p.coat_facets, from, to).pdf_from_light;
  if (fuzzy_) d[fuzz] = chosen.share[fuzz] * FuzzLobe<double>(from, p.fuzz_roughness).density(to);
  return d;
}

Vec2 OpenPbrReflection::invert_lobe(const Point<double>& p, size_t lobe, const Vec3& from,
                                    const Vec3& to) const {
  if (lobe == diffuse) return invert_cosine_hemisphere(to);
  if (lobe == fuzz) return FuzzLobe<double>(from, p.fuzz_roughness).invert(to);
  return Microfacet(lobe == coat ? p.coat_facets : p.facets).invert(from, normalize(from + to));
}

template OpenPbrPoint<double> OpenPbrReflection::point(const SurfacePoint* const*) const;
template OpenPbrShares<double> OpenPbrReflection::shares(const Point<double>&, const Vec3&) const;
template LobeShares<OpenPbrReflection::lobe_count> OpenPbrReflection::choice(
    const Point<double>&, const OpenPbrShares<double>&) const;
template OpenPbrTerms<double> OpenPbrReflection::terms(const Point<double>&, const Vec3&,
                                                       const Vec3&) const;

}  // namespace mlt
