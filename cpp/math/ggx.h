// The GGX (Trowbridge-Reitz) distribution of microfacet normals, sampled by those that are visible;
// see microfacet.h. F is double, or Float8 for points side by side.
#pragma once

#include "math/warp.h"

namespace mlt {

enum class MicrofacetType { beckmann, ggx };

template <class F>
struct Ggx {
  using Vec3 = Vec3Of<F>;
  F alpha_u, alpha_v;

  static constexpr MicrofacetType type() { return MicrofacetType::ggx; }
  static constexpr bool sample_visible() { return true; }
  F least_alpha() const { return min(alpha_u, alpha_v); }

  /// Walter et al. 2007, eq. 33.
  F D(const Vec3& m) const {
    const F s2 = sqr(m.x / alpha_u) + sqr(m.y / alpha_v), z2 = m.z * m.z;
    return select(m.z > 0, 1 / (number<F>(pi) * alpha_u * alpha_v * sqr(s2 + z2)), F(0));
  }
  F g1(const Vec3& v, const Vec3& m) const {
    return select(dot(v, m) * v.z > 0, abs(v.z) * g1_over_cos(v), F(0));
  }
  F g1_fit(const Vec3& v, const Vec3& m) const { return g1(v, m); }
  /// G1(v) / |cos v|, finite at grazing angles.
  F g1_over_cos(const Vec3& v) const {
    const F z = abs(v.z), r2 = sqr(alpha_u * v.x) + sqr(alpha_v * v.y);
    return 2 / (z + sqrt(z * z + r2));
  }

  /// On a hemisphere, mirror reflection of wi spreads visible normals evenly over the spherical cap
  /// of directions c with c.z > -wi.z (Dupuy & Benyoub 2023, sec. 3).
  Vec3 sample(const Vec3& wi, const Vec2Of<F>& u) const {
    const Vec3 w = stretch(wi);
    const F h = u.x * (1 + w.z);  // 1 - c.z
    const F r = sqrt(h * (2 - h));
    const SinCosOf<F> phi = sincos_turns(u.y);
    return stretch({r * phi.cos + w.x, r * phi.sin + w.y, (1 - u.x) * (1 + w.z)});
  }

  /// Transforms a normal of the surface of roughness 1 to this one.
  Vec3 stretch(const Vec3& m) const { return normalize(Vec3(alpha_u * m.x, alpha_v * m.y, m.z)); }
};

}  // namespace mlt
