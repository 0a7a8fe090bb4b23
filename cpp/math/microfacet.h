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

#include "math/frame.h"
#include "math/number.h"
#include "math/warp.h"

namespace mlt {

enum class MicrofacetType { beckmann, ggx };

template <class F>
class MicrofacetOf {
  using Vec3 = Vec3Of<F>;
  using Vec2 = Vec2Of<F>;

 public:
  static constexpr double min_alpha = 1e-4;

  /// Smaller roughnesses count as min_alpha. `sample_visible`: sample() draws from the normals that
  /// are visible from wi, else from all of them with density D(m) cos m.
  MicrofacetOf(MicrofacetType type, F alpha_u, F alpha_v, bool sample_visible = true)
      : type_(type),
        sample_visible_(sample_visible),
        alpha_u_(max(alpha_u, number<F>(min_alpha))),
        alpha_v_(max(alpha_v, number<F>(min_alpha))) {}
  /// The same distribution for other numbers.
  template <class G>
  explicit MicrofacetOf(const MicrofacetOf<G>& other)
      : MicrofacetOf(other.type(), number<F>(other.alpha_u()), number<F>(other.alpha_v()),
                     other.sample_visible()) {}

  MicrofacetType type() const { return type_; }
  F alpha_u() const { return alpha_u_; }
  F alpha_v() const { return alpha_v_; }
  bool sample_visible() const { return sample_visible_; }

  /// D(m), the density of microfacet area by normal; 0 below the surface.
  F D(const Vec3& m) const {
    const F s2 = sqr(m.x / alpha_u_) + sqr(m.y / alpha_v_), z2 = m.z * m.z;
    const F area = number<F>(pi) * alpha_u_ * alpha_v_;
    if (type_ == MicrofacetType::ggx)  // Walter eq. 33
      return select(m.z > 0, 1 / (area * sqr(s2 + z2)), F(0));
    return select((m.z > 0) & (s2 < number<F>(700) * z2), exp(-s2 / z2) / (area * z2 * z2),
                  F(0));  // 25
  }

  /// The exact masking function of Smith: int G1(v, m) |<v, m>| D(m) dm = |cos v|. It is 0 if v is
  /// on different sides of m and of the surface.
  F g1(const Vec3& v, const Vec3& m) const {
    return select(consistent(v, m), abs(v.z) * g1_over_cos(v), F(0));
  }

  /// Separable masking and shadowing, with g1_fit, as in Mitsuba; for BSDF values.
  F G(const Vec3& wi, const Vec3& wo, const Vec3& m) const { return g1_fit(wi, m) * g1_fit(wo, m); }

  /// g1, but for Beckmann the rational fit of Walter et al. (sec. 5.2), off by up to 0.35 %.
  /// Densities need g1 itself, so value / pdf is not just G1(wo).
  F g1_fit(const Vec3& v, const Vec3& m) const {
    if (type_ == MicrofacetType::ggx) return g1(v, m);
    const F a = abs(v.z) / rough_radius(v);
    const F fit = a * (number<F>(3.535) + number<F>(2.181) * a) /
                  (1 + a * (number<F>(2.276) + number<F>(2.577) * a));
    return select(consistent(v, m), select(a >= number<F>(1.6), F(1), fit), F(0));
  }

  /// Samples a normal m with m.z > 0, for wi.z > 0 (flip wi to sample from the other side).
  Vec3 sample(const Vec3& wi, const Vec2& u) const {
    if (sample_visible_ && type_ == MicrofacetType::ggx) return sample_visible_ggx(wi, u);
    if constexpr (is_number<F>)
      return sample_visible_ ? sample_visible_beckmann(wi, u) : sample_any(u);
    else
      return sample_each(wi, u);
  }

  /// The density of sample() in solid angle of m.
  F pdf(const Vec3& wi, const Vec3& m) const {
    if (!sample_visible_) return D(m) * m.z;
    const F wm = dot(wi, m);  // Heitz & d'Eon, eq. 2
    return select((wi.z > 0) & (wm > 0), D(m) * wm * g1_over_cos(wi), F(0));
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

  // Visible GGX normals. On a hemisphere, mirror reflection of wi spreads visible normals evenly
  // over the spherical cap of directions c with c.z > -wi.z (Dupuy & Benyoub 2023, sec. 3).
  Vec3 sample_visible_ggx(const Vec3& wi, const Vec2& u) const {
    const Vec3 w = stretch(wi);
    const F h = u.x * (1 + w.z);  // 1 - c.z
    const F r = sqrt(h * (2 - h));
    const SinCosOf<F> phi = sincos_turns(u.y);
    return stretch({r * phi.cos + w.x, r * phi.sin + w.y, (1 - u.x) * (1 + w.z)});
  }
  /// sample() of each lane.
  Vec3 sample_each(const Vec3& wi, const Vec2& u) const {
    mlt::Vec3 m[F::size()];
    for (int i = 0; i < int(F::size()); ++i)
      m[i] = MicrofacetOf<double>(type_, alpha_u_[i], alpha_v_[i], sample_visible_)
                 .sample({wi.x[i], wi.y[i], wi.z[i]}, {u.x[i], u.y[i]});
    return {for_each_lane<F>([&](int i) { return m[i].x; }),
            for_each_lane<F>([&](int i) { return m[i].y; }),
            for_each_lane<F>([&](int i) { return m[i].z; })};
  }

  static auto consistent(const Vec3& v, const Vec3& m) { return dot(v, m) * v.z > 0; }

  F rough_radius(const Vec3& v) const { return sqrt(sqr(alpha_u_ * v.x) + sqr(alpha_v_ * v.y)); }

  /// G1(v) / |cos v|, finite at grazing angles; a = |cos v| / rough_radius(v).
  F g1_over_cos(const Vec3& v) const {
    const F z = abs(v.z), r = rough_radius(v);
    if (type_ == MicrofacetType::ggx) return 2 / (z + sqrt(z * z + r * r));
    const auto steep = z > 6 * r;  // erfc(6) = 2e-17
    if constexpr (is_number<F>)
      if (steep) return 1 / z;
    const F a = z / r;
    return select(steep, 1 / z, 2 / (z * (1 + erf(a)) + r * exp(-a * a) / number<F>(sqrt_pi)));
  }

  /// Transforms a normal of the surface of roughness 1 to this one.
  Vec3 stretch(const Vec3& m) const { return normalize(Vec3(alpha_u_ * m.x, alpha_v_ * m.y, m.z)); }
  Vec3 unstretch(const Vec3& m) const {
    return normalize(Vec3(m.x / alpha_u_, m.y / alpha_v_, m.z));
  }

  static constexpr double sqrt_pi = 1.77245385090551602730;

  MicrofacetType type_;
  bool sample_visible_;
  F alpha_u_, alpha_v_;
};
using Microfacet = MicrofacetOf<double>;

template <>
Vec3 Microfacet::sample_any(const Vec2& u) const;
template <>
Vec2 Microfacet::invert_any(const Vec3& m) const;
template <>
Vec2 Microfacet::invert_visible_ggx(const Vec3& wi, const Vec3& m) const;
template <>
Vec3 Microfacet::sample_visible_beckmann(const Vec3& wi, const Vec2& u) const;
template <>
Vec2 Microfacet::invert_visible_beckmann(const Vec3& wi, const Vec3& m) const;

}  // namespace mlt
