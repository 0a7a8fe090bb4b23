// Microfacet normal distributions: Beckmann and GGX (Trowbridge-Reitz), isotropic or anisotropic,
// with Smith masking and two ways to sample normals. Directions are in the local frame.
//   Walter et al. 2007, "Microfacet models for refraction through rough surfaces"
//   Heitz 2014, "Understanding the masking-shadowing function in microfacet-based BRDFs"
//   Heitz & d'Eon 2014, "Importance sampling microfacet-based BSDFs using the distribution of
//   visible normals"
//   Dupuy & Benyoub 2023, "Sampling visible GGX normals with spherical caps"
// Sampling works on a surface of roughness 1 and then stretches it: the normal (x, y, z) there
// becomes (alpha_u x, alpha_v y, z), normalised, and directions transform likewise.
#pragma once

#include "math/beckmann.h"
#include "math/ggx.h"

namespace mlt {

class Microfacet {
 public:
  static constexpr double min_alpha = 1e-4;

  /// Smaller roughnesses count as min_alpha. `sample_visible`: sample() draws from the normals that
  /// are visible from wi, else from all of them with density D(m) cos m.
  Microfacet(MicrofacetType type, double alpha_u, double alpha_v, bool sample_visible = true)
      : type_(type),
        sample_visible_(sample_visible),
        alpha_u_(std::max(alpha_u, min_alpha)),
        alpha_v_(std::max(alpha_v, min_alpha)) {}

  explicit Microfacet(const Ggx<double>& ggx)
      : Microfacet(MicrofacetType::ggx, ggx.alpha_u, ggx.alpha_v) {}

  MicrofacetType type() const { return type_; }
  double alpha_u() const { return alpha_u_; }
  double alpha_v() const { return alpha_v_; }
  bool sample_visible() const { return sample_visible_; }
  // This distribution, if it is of that kind:
  Ggx<double> ggx() const { return {alpha_u_, alpha_v_}; }
  Beckmann<double> beckmann() const { return {alpha_u_, alpha_v_}; }

  /// D(m), the density of microfacet area by normal; 0 below the surface.
  double D(const Vec3& m) const {
    if (type_ == MicrofacetType::ggx) return ggx().D(m);
    return beckmann().D(m);
  }

  /// The exact masking function of Smith: int G1(v, m) |<v, m>| D(m) dm = |cos v|. It is 0 if v is
  /// on different sides of m and of the surface.
  double g1(const Vec3& v, const Vec3& m) const {
    return consistent(v, m) ? std::abs(v.z) * g1_over_cos(v) : 0;
  }

  /// Separable masking and shadowing, with g1_fit, as in Mitsuba; for BSDF values.
  double G(const Vec3& wi, const Vec3& wo, const Vec3& m) const {
    return g1_fit(wi, m) * g1_fit(wo, m);
  }

  /// g1, but for Beckmann the rational fit of Walter et al. (sec. 5.2), off by up to 0.35 %.
  /// Densities need g1 itself, so value / pdf is not just G1(wo).
  double g1_fit(const Vec3& v, const Vec3& m) const {
    if (type_ == MicrofacetType::ggx) return g1(v, m);
    if (!consistent(v, m)) return 0;
    const double a = std::abs(v.z) / rough_radius(v);
    if (a >= 1.6) return 1;
    return a * (3.535 + 2.181 * a) / (1 + a * (2.276 + 2.577 * a));
  }

  /// Samples a normal m with m.z > 0, for wi.z > 0 (flip wi to sample from the other side).
  Vec3 sample(const Vec3& wi, const Vec2& u) const {
    if (!sample_visible_) return sample_any(u);
    return type_ == MicrofacetType::ggx ? ggx().sample(wi, u) : sample_visible_beckmann(wi, u);
  }

  /// The density of sample() in solid angle of m.
  double pdf(const Vec3& wi, const Vec3& m) const {
    if (!sample_visible_) return D(m) * m.z;
    const double wm = dot(wi, m);
    return wi.z > 0 && wm > 0 ? D(m) * wm * g1_over_cos(wi) : 0;  // Heitz & d'Eon, eq. 2
  }

  /// The u that sample() maps to m.
  Vec2 invert(const Vec3& wi, const Vec3& m) const {
    if (!sample_visible_) return invert_any(m);
    return type_ == MicrofacetType::ggx ? invert_visible_ggx(wi, m)
                                        : invert_visible_beckmann(wi, m);
  }

 private:
  Vec3 sample_any(const Vec2& u) const;
  Vec2 invert_any(const Vec3& m) const;
  Vec2 invert_visible_ggx(const Vec3& wi, const Vec3& m) const;
  Vec3 sample_visible_beckmann(const Vec3& wi, const Vec2& u) const;
  Vec2 invert_visible_beckmann(const Vec3& wi, const Vec3& m) const;

  static bool consistent(const Vec3& v, const Vec3& m) { return dot(v, m) * v.z > 0; }

  double rough_radius(const Vec3& v) const {
    return std::sqrt(sqr(alpha_u_ * v.x) + sqr(alpha_v_ * v.y));
  }

  /// G1(v) / |cos v|, finite at grazing angles; a = |cos v| / rough_radius(v).
  double g1_over_cos(const Vec3& v) const {
    if (type_ == MicrofacetType::ggx) return ggx().g1_over_cos(v);
    const double z = std::abs(v.z), r = rough_radius(v);
    if (z > 6 * r) return 1 / z;  // erfc(6) = 2e-17
    const double a = z / r;
    return 2 / (z * (1 + std::erf(a)) + r * std::exp(-a * a) / sqrt_pi);
  }

  /// Transforms a normal of the surface of roughness 1 to this one.
  Vec3 stretch(const Vec3& m) const { return ggx().stretch(m); }
  Vec3 unstretch(const Vec3& m) const {
    return normalize(Vec3(m.x / alpha_u_, m.y / alpha_v_, m.z));
  }

  static constexpr double sqrt_pi = 1.77245385090551602730;

  MicrofacetType type_;
  bool sample_visible_;
  double alpha_u_, alpha_v_;
};

}  // namespace mlt
