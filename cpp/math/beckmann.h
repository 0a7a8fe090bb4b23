// The Beckmann distribution of microfacet normals, all of which are sampled; see microfacet.h. F is
// double, or Float8 for points side by side.
#pragma once

#include "math/warp.h"

namespace mlt {

template <class F>
struct Beckmann {
  using Vec3 = Vec3Of<F>;
  F alpha_u, alpha_v;

  F least_alpha() const { return min(alpha_u, alpha_v); }

  /// Walter et al. 2007, eq. 25; 0 below the surface.
  F D(const Vec3& m) const {
    const F s2 = sqr(m.x / alpha_u) + sqr(m.y / alpha_v), z2 = m.z * m.z;
    const auto found = (m.z > 0) & (s2 < 700 * z2);
    const F t = select(found, s2 / z2, F(0));
    const F power = for_each_lane<F>([&](int i) { return std::exp(-lane_of(t, i)); });
    return select(found, power / (number<F>(pi) * alpha_u * alpha_v * (z2 * z2)), F(0));
  }

  /// A normal with density D(m) cos m: in units of the roughness the slopes are isotropic, with
  /// squared radius t and 1 - u = exp(-t) (Walter et al. 2007, eq. 28).
  Vec3 sample(const Vec2Of<F>& u) const {
    const F r = sqrt(for_each_lane<F>([&](int i) { return -std::log1p(-lane_of(u.x, i)); }));
    const SinCosOf<F> phi = sincos_turns(u.y);
    return normalize(Vec3(alpha_u * r * phi.cos, alpha_v * r * phi.sin, F(1)));
  }
  Vec2 invert(const Vec3& m) const {
    const double x = m.x / (alpha_u * m.z), y = m.y / (alpha_v * m.z);
    return {-std::expm1(-(x * x + y * y)), turns(x, y)};
  }
};

}  // namespace mlt
