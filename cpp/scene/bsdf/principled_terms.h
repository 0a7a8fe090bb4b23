// Terms of the two principled materials: those of Burley 2012, "Physically based shading at
// Disney", and Burley 2015, "Extending the Disney BRDF to a BSDF with integrated subsurface
// scattering", in the form of Mitsuba 3.
#pragma once

#include "math/microfacet.h"
#include "math/spectrum.h"
#include "scene/bsdf/lobes.h"

namespace mlt {

/// Schlick's weight (1 - cos)^5 (Schlick 1994, eq. 24).
template <class F>
F schlick_weight(F cosine) {
  const F m = min(max(1 - cosine, F(0)), F(1));
  return sqr(sqr(m)) * m;
}
/// The weight w of Schlick's reflectance R0 + (1 - R0) w of an interface, by the cosine >= 0 of
/// light from above.
template <class F>
F schlick_weight(F cosine, double eta) {
  if (eta > 1) return schlick_weight(cosine);
  return schlick_weight(sqrt(max(F(0), 1 - (1 - sqr(cosine)) * number<F>(1 / sqr(eta)))));
}

/// The hue of the base colour, at luminance 1.
inline Spectrum tint_of(const Spectrum& base) {
  const double l = luminance(base);
  return l > 0 ? base / l : Spectrum(1);
}

/// A colour: `base` times the base colour, `tint` times its hue, and white.
template <class F>
struct TintedOf {
  F base{0}, tint{0}, white{0};

  TintedOf& operator+=(const TintedOf& other) {
    base += other.base;
    tint += other.tint;
    white += other.white;
    return *this;
  }
  TintedOf<double> of_lane(int i) const { return {base[i], tint[i], white[i]}; }
};
using Tinted = TintedOf<double>;
template <class F>
TintedOf<F> operator*(F factor, const TintedOf<F>& c) {
  return {factor * c.base, factor * c.tint, factor * c.white};
}
inline Spectrum color_of(const Tinted& c, const Spectrum& base, const Spectrum& hue) {
  return c.base * base + c.tint * hue + Spectrum(c.white);
}

/// Schlick's reflectance of a metal of the base colour, by the weight w.
template <class F>
TintedOf<F> schlick_metal(F w) {
  return {1 - w, F(0), w};
}
/// Schlick's reflectance of a dielectric of the base's hue, by the weight w.
template <class F>
TintedOf<F> schlick_tinted(F w, double eta) {
  return {F(0), (1 - w) * number<F>(sqr((eta - 1) / (eta + 1))), w};
}

/// GGX with Burley's roughness^2, and anisotropy by the aspect sqrt(1 - 0.9 anisotropic).
template <class F>
Ggx<F> principled_microfacet(F roughness, F anisotropic) {
  const F aspect = sqrt(1 - number<F>(0.9) * anisotropic), least = number<F>(0.001);
  return {max(least, sqr(roughness) / aspect), max(least, sqr(roughness) * aspect)};
}

/// The BSDF of a Lambertian base over colour / pi: Burley's diffuse term with retroreflection,
/// mixed by `flatness` with his approximation of subsurface scattering. cos_d is the cosine with
/// the half vector.
template <class F>
F principled_diffuse(F cos_l, F cos_c, F cos_d, F roughness, F flatness) {
  const F half = number<F>(0.5), Fl = schlick_weight(cos_l), Fc = schlick_weight(cos_c);
  const F Rr = 2 * roughness * sqr(cos_d);
  const F diffuse = (1 - half * Fl) * (1 - half * Fc) + Rr * (Fl + Fc + Fl * Fc * (Rr - 1));
  const F Fss = (1 + Fl * (half * Rr - 1)) * (1 + Fc * (half * Rr - 1));
  const F flat = number<F>(1.25) * (Fss * (1 / (cos_l + cos_c) - half) + half);
  return diffuse + flatness * (flat - diffuse);
}
/// Its sheen, a layer that brightens grazing angles.
template <class F>
TintedOf<F> principled_sheen(F cos_d, F sheen, F sheen_tint) {
  const F w = sheen * schlick_weight(abs(cos_d));
  return {F(0), w * sheen_tint, w * (1 - sheen_tint)};
}

/// The distribution of the clear coat's normals, with the tails of gamma = 1 (Burley 2012, appendix
/// B.2): D = (alpha^2 - 1) / (pi log alpha^2 (1 + (alpha^2 - 1) cos^2)).
template <class F>
struct ClearCoat {
  F alpha2, log_alpha2;

  static F alpha(F gloss) { return number<F>(0.1) + gloss * number<F>(0.001 - 0.1); }
  static ClearCoat of_gloss(F gloss) {
    const F alpha2 = sqr(alpha(gloss));
    return {alpha2, for_each_lane<F>([&](int i) { return std::log(lane_of(alpha2, i)); })};
  }

  F D(const Vec3Of<F>& h) const {
    const F sin2 = sqr(h.x) + sqr(h.y);
    return (alpha2 - 1) / (number<F>(pi) * log_alpha2 * (sin2 + alpha2 * sqr(h.z)));
  }
  Vec3Of<F> sample(const Vec2Of<F>& u) const {
    const F power = -u.x * log_alpha2;
    const F sin2 = alpha2 / (1 - alpha2) *
                   for_each_lane<F>([&](int i) { return std::expm1(lane_of(power, i)); });
    const SinCosOf<F> phi = sincos_turns(u.y);
    const F r = sqrt(min(sin2, F(1)));
    return {r * phi.cos, r * phi.sin, sqrt(max(F(0), 1 - sin2))};
  }
  Vec2 invert(const Vec3& h) const {
    return {-std::log1p(sin2_theta(h) * (1 - alpha2) / alpha2) / log_alpha2, turns(h.x, h.y)};
  }
  /// Masking and shadowing, as of GGX of roughness 0.25.
  static F G(const Vec3Of<F>& wl, const Vec3Of<F>& wc, const Vec3Of<F>& h) {
    const Ggx<F> microfacet{number<F>(0.25), number<F>(0.25)};
    return microfacet.g1(wl, h) * microfacet.g1(wc, h);
  }
  static F fresnel(F cosine, double eta) {
    return number<F>(0.04) + number<F>(0.96) * schlick_weight(cosine, eta);
  }
};

/// The probabilities of the lobes that a sample chooses from.
template <size_t n, class F = double>
struct LobeShares {
  F share[n];

  /// Probabilities in proportion to weights that are not negative.
  explicit LobeShares(const F (&weight)[n]) {
    F sum(0);
    for (const F& w : weight) sum += w;
    for (size_t i = 0; i < n; ++i) share[i] = select(sum > 0, weight[i] / sum, F(0));
  }
  /// The lobe that u chooses; u is rescaled. n if all weights are 0.
  size_t choose(double& u) const {
    size_t last = n;
    double below = 0;
    for (size_t i = 0; i < n; below += share[i++]) {
      if (!(share[i] > 0)) continue;
      last = i;
      if (u < below + share[i]) break;
    }
    if (last == n) return n;
    double before = 0;
    for (size_t i = 0; i < last; ++i) before += share[i];
    u = std::clamp((u - before) / share[last], 0.0, 1 - 0x1p-53);
    return last;
  }
  /// Chooses which lobe has sampled a direction, of which they have these densities, if v is
  /// uniform; v is rescaled.
  template <class Densities>
  static size_t guess(const Densities& densities, double& v) {
    double weights[n];
    std::copy(std::begin(densities), std::end(densities), weights);
    return LobeShares(weights).choose(v);
  }
  /// A number that chooses lobe i and leaves u.
  double invert(size_t i, double u) const {
    double before = 0;
    for (size_t k = 0; k < i; ++k) before += share[k];
    return std::min(before + u * share[i], 1 - 0x1p-53);
  }
};

/// The parameters of the material at a point.
template <class F>
struct PrincipledPoint {
  F roughness, metallic, spec_tint, sheen, sheen_tint, flatness, clearcoat;
  F brdf, bsdf;  ///< Shares of the opaque and of the refracting dielectric.
  Ggx<F> microfacet;
  ClearCoat<F> coat;
};

/// Values and densities of reflection above the surface.
template <class F>
struct PrincipledTerms {
  TintedOf<F> diffuse, specular;
  F clearcoat, pdf_from_light, pdf_from_camera;
  PrincipledTerms<double> of_lane(int i) const {
    return {diffuse.of_lane(i), specular.of_lane(i), clearcoat[i], 0, 0};
  }
};

}  // namespace mlt
