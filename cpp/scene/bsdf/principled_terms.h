// Terms of the two principled materials: those of Burley 2012, "Physically based shading at
// Disney", and Burley 2015, "Extending the Disney BRDF to a BSDF with integrated subsurface
// scattering", in the form of Mitsuba 3.
#pragma once

#include "base/params.h"
#include "math/microfacet.h"
#include "math/warp.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture.h"

namespace mlt {

/// Schlick's weight (1 - cos)^5 (Schlick 1994, eq. 24).
inline double schlick_weight(double cosine) {
  const double m = std::clamp(1 - cosine, 0.0, 1.0);
  return sqr(sqr(m)) * m;
}

/// Schlick's reflectance R0 + (1 - R0) (1 - cos)^5, by the cosine >= 0 in the thinner medium.
inline Spectrum schlick(const Spectrum& R0, double cosine, double eta) {
  if (eta <= 1) cosine = std::sqrt(std::max(0.0, 1 - (1 - sqr(cosine)) / sqr(eta)));
  const double w = schlick_weight(cosine);
  return R0 + w * (Spectrum(1) - R0);
}

/// The hue of the base colour, at luminance 1.
inline Spectrum tint_of(const Spectrum& base) {
  const double l = luminance(base);
  return l > 0 ? base / l : Spectrum(1);
}
inline Spectrum tinted(const Spectrum& base, double amount) {
  return Spectrum(1) + amount * (tint_of(base) - Spectrum(1));
}
/// Schlick's reflectance of a tinted dielectric.
inline Spectrum tinted_schlick(const Spectrum& base, double cosine, double eta) {
  return schlick(tint_of(base) * sqr((eta - 1) / (eta + 1)), cosine, eta);
}

/// GGX with Burley's roughness^2, and anisotropy by the aspect sqrt(1 - 0.9 anisotropic).
inline Microfacet principled_microfacet(double roughness, double anisotropic) {
  const double aspect = std::sqrt(1 - 0.9 * anisotropic);
  return {MicrofacetType::ggx, std::max(0.001, sqr(roughness) / aspect),
          std::max(0.001, sqr(roughness) * aspect)};
}

/// The BSDF of a Lambertian base over colour / pi: Burley's diffuse term with retroreflection,
/// mixed by `flatness` with his approximation of subsurface scattering. cos_d is the cosine with
/// the half vector.
inline double principled_diffuse(double cos_l, double cos_c, double cos_d, double roughness,
                                 double flatness) {
  const double Fl = schlick_weight(cos_l), Fc = schlick_weight(cos_c);
  const double Rr = 2 * roughness * sqr(cos_d);
  const double diffuse = (1 - 0.5 * Fl) * (1 - 0.5 * Fc) + Rr * (Fl + Fc + Fl * Fc * (Rr - 1));
  const double Fss = (1 + Fl * (0.5 * Rr - 1)) * (1 + Fc * (0.5 * Rr - 1));
  const double flat = 1.25 * (Fss * (1 / (cos_l + cos_c) - 0.5) + 0.5);
  return diffuse + flatness * (flat - diffuse);
}

/// The distribution of the clear coat's normals, with the tails of gamma = 1 (Burley 2012, appendix
/// B.2): D = (alpha^2 - 1) / (pi log alpha^2 (1 + (alpha^2 - 1) cos^2)).
struct ClearCoat {
  double alpha2;

  explicit ClearCoat(double gloss) : alpha2(sqr(0.1 + gloss * (0.001 - 0.1))) {}

  double D(const Vec3& h) const {
    return (alpha2 - 1) / (pi * std::log(alpha2) * (sin2_theta(h) + alpha2 * sqr(h.z)));
  }
  Vec3 sample(const Vec2& u) const {
    const double sin2 = alpha2 * std::expm1(-u.x * std::log(alpha2)) / (1 - alpha2);
    const SinCos phi = sincos_turns(u.y);
    const double r = std::sqrt(std::min(sin2, 1.0));
    return {r * phi.cos, r * phi.sin, std::sqrt(std::max(0.0, 1 - sin2))};
  }
  Vec2 invert(const Vec3& h) const {
    return {-std::log1p(sin2_theta(h) * (1 - alpha2) / alpha2) / std::log(alpha2), turns(h.x, h.y)};
  }
  /// Masking and shadowing, as of GGX of roughness 0.25.
  static double G(const Vec3& wl, const Vec3& wc, const Vec3& h) {
    return Microfacet(MicrofacetType::ggx, 0.25, 0.25).G(wl, wc, h);
  }
  static double fresnel(double cosine, double eta) {
    return schlick(Spectrum(0.04), cosine, eta)[0];
  }
};

/// The probabilities of the lobes that a sample chooses from.
template <size_t n>
struct LobeShares {
  double share[n];

  /// Probabilities in proportion to weights that are not negative.
  explicit LobeShares(const double (&weight)[n]) {
    double sum = 0;
    for (const double w : weight) sum += w;
    for (size_t i = 0; i < n; ++i) share[i] = sum > 0 ? weight[i] / sum : 0;
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

}  // namespace mlt
