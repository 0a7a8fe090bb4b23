// The colours of OpenPBR's lobes, and the film, the coat and the pane that change them.
#include "scene/bsdf/openpbr_reflection.h"

namespace mlt {
namespace {

Spectrum power_of(const Spectrum& base, double exponent) {
  return lane_by_lane(base, [&](double x) { return std::pow(x, exponent); });
}

Spectrum lerp(const Spectrum& a, const Spectrum& b, double weight) { return a + weight * (b - a); }

}  // namespace

OpenPbrReflection::Colors OpenPbrReflection::colors(const SurfacePoint& at) const {
  const OpenPbrTextures& t = textures_;
  Colors c;
  c.rho = t.base(at);
  if (thin_ && transmits_) {
    const double S = t.subsurface_weight.eval(at), g = t.subsurface_anisotropy;
    const Spectrum scattered = 0.5 * S * t.subsurface_color->eval(at);
    c.rho = (1 - S) * c.rho + (1 - g) * scattered;
    c.rho_through = (1 + g) * scattered;
    c.enters = t.transmission_weight.eval(at);
    c.within = t.transmission_color->eval(at);
  }
  if (rough_base_) {
    const EnergyPreservingOrenNayar<double> diffuse(t.base_diffuse_roughness.eval(at));
    c.rho_again = multiply_scattered(c.rho, diffuse.mean_albedo());
  }
  c.specular = t.specular_color->eval(at);
  if (metallic_) c.metal = MetalColors(c.rho, c.specular);
  if (fuzzy_) c.fuzz = t.fuzz_color->eval(at);
  if (coated_) {
    c.coat_weight = t.coat_weight.eval(at);
    c.coat = t.coat_color->eval(at);
    c.darkening = darkening(at, c.rho, c.coat_weight);
  }
  if (film_) {
    const SurfacePoint* one = &at;
    c.film_weight = t.thin_film_weight.eval(at);
    c.gloss = t.gloss<double>(&one);
    c.roughness = t.specular_roughness.eval(at);
    c.wavelength = at.wavelength;
  }
  return c;
}

/// "Darkening": (1 - K) / (1 - E_b K), with F(normal incidence) for a smooth base, as F(w) would
/// not be symmetric.
Spectrum OpenPbrReflection::darkening(const SurfacePoint& at, const Spectrum& base,
                                      double weight) const {
  const OpenPbrTextures& t = textures_;
  const double eta = t.coat_ior, F0 = sqr((eta - 1) / (eta + 1));
  const double r = t.specular_roughness.eval(at), M = t.base_metalness.eval(at);
  const double T = t.transmission_weight.eval(at), S = t.subsurface_weight.eval(at);
  const double F = sqr((eta_ - 1) / (eta_ + 1)), mirrors = M + (1 - M) * (F + (1 - F) * T);
  const double smooth = 1 - (1 - r) * mirrors;
  const double rough = 1 - (1 - coat_mean_fresnel_) / sqr(eta), K = F0 + smooth * (rough - F0);
  const Spectrum opaque = S > 0 ? lerp(base, t.subsurface_color->eval(at), S) : base;
  const Spectrum albedo = (M + (1 - M) * (1 - T)) * lerp(opaque, base, M);
  const Spectrum left = Spectrum(1 - K) / (Spectrum(1) - K * albedo);
  return lerp(Spectrum(1), left, weight * t.coat_darkening);
}

Spectrum OpenPbrReflection::value(const Colors& c, const Terms<double>& t) const {
  Spectrum base = t.diffuse_once * c.rho;
  if (rough_base_) base += t.diffuse_twice * c.rho_again;
  if (c.film_weight > 0) base *= under_film(c, t);
  if (film_ || c.enters > 0) {
    Spectrum glossy = interface_reflectance(c, t.cos_h, t.fresnel);
    if (c.enters > 0) glossy = lerp(glossy, pane(c, glossy, t.cos_h).reflected, c.enters);
    base += t.gloss * c.specular * glossy;
  } else {
    base += (t.gloss * t.fresnel) * c.specular;
  }
  if (t.metal > 0) {
    Spectrum F = c.metal.at(t.angle);
    if (c.film_weight > 0) F = lerp(F, film_->metal(t.cos_h, c.wavelength, F), c.film_weight);
    base += t.metal * F * (Spectrum(1) + t.metal_again * c.metal.mean());
  }
  if (c.coat_weight > 0) {
    base *= c.darkening;
    base *= through_coat(c, 2 * t.coat_path);
    base += Spectrum(t.coat);
  }
  return fuzzy_ ? base + t.fuzz * c.fuzz : base;
}

Spectrum OpenPbrReflection::interface_reflectance(const Colors& c, double cosine,
                                                  double fresnel) const {
  if (!(c.film_weight > 0)) return Spectrum(fresnel);
  return lerp(Spectrum(fresnel), film_->dielectric(cosine, c.wavelength), c.film_weight);
}

/// What the diffuse base gets below the film, over what it gets without one: the table's
/// reflectances grow as Fresnel's do.
Spectrum OpenPbrReflection::under_film(const Colors& c, const Terms<double>& t) const {
  const auto left = [&](double E, const Spectrum& F, double plain) {
    const Spectrum filmed = E * (F / std::max(plain, 1e-6));
    return max(Spectrum(1e-3), Spectrum(1) - filmed) / (1 - E);
  };
  const auto along = [&](double cosine) {
    const double E = c.gloss * energy_->reflectance.at(cosine, c.roughness);
    const double plain = reflectance(cosine);
    return left(E, interface_reflectance(c, cosine, plain), plain);
  };
  const Spectrum mean = lerp(Spectrum(mean_fresnel_), film_->mean(c.wavelength), c.film_weight);
  return along(t.cos_l) * along(t.cos_c) /
         left(c.gloss * energy_->mean.at(c.roughness), mean, mean_fresnel_);
}

OpenPbrReflection::Pane OpenPbrReflection::pane(const Colors& c, const Spectrum& F,
                                                double cosine) const {
  const double inside = std::sqrt(std::max(1e-4, 1 - (1 - sqr(cosine)) / sqr(eta_)));
  const Spectrum a = power_of(c.within, 1 / inside), T = Spectrum(1) - F;
  const Spectrum ladder = T * T * a / max(Spectrum(1e-9), Spectrum(1) - F * F * a * a);
  return {F + F * a * ladder, ladder};
}

Spectrum OpenPbrReflection::through_coat(const Colors& c, double path) const {
  if (!(c.coat_weight > 0 && coat_tints_)) return Spectrum(1);
  return lerp(Spectrum(1), power_of(c.coat, 0.5 * path), c.coat_weight);
}

double OpenPbrReflection::roughness_of(const Colors& c, const Point<double>& p,
                                       const Terms<double>& t) const {
  Terms<double> base = t, smooth = t;
  base.coat = base.fuzz = base.diffuse_once = base.diffuse_twice = 0;
  smooth.coat = smooth.gloss = smooth.metal = 0;
  const double glossy = target_luminance(value(c, base)),
               diffuse = target_luminance(value(c, smooth));
  if (t.coat > std::max(glossy, diffuse)) return p.coat_facets.least_alpha();
  return glossy > diffuse ? p.facets.least_alpha() : infinity;
}

}  // namespace mlt
