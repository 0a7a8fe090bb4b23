// An orthonormal frame, and the trigonometry of directions in it (n is the z axis).
#pragma once

#include "math/number.h"

namespace mlt {

template <class F>
struct FrameOf {
  using Vec3 = Vec3Of<F>;
  Vec3 s, t, n;

  Vec3 to_local(const Vec3& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
  Vec3 to_world(const Vec3& v) const { return s * v.x + t * v.y + n * v.z; }

  /// A frame around `n`: Duff et al. 2017, "Building an orthonormal basis, revisited".
  static FrameOf around(const Vec3& n) {
    const F sign = copysign(F(1), n.z);
    const F a = -1 / (sign + n.z);
    const F b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
  }

  /// A frame around `n` whose s axis lies in the plane of `n` and `along` (dp/du).
  static FrameOf around(const Vec3& n, const Vec3& along) { return around(n, n, along); }

  /// As above; `m` has the direction of `n` and any length: the square roots that normalise the two
  /// axes can then be computed in parallel.
  static FrameOf around(const Vec3& n, const Vec3& m, const Vec3& along) {
    const Vec3 t = cross(m, along);
    const F l2 = dot(t, t);
    if (!(l2 > 1e-20 * dot(along, along) * dot(m, m))) return around(n);
    const Vec3 unit = t * (1 / std::sqrt(l2));
    return {cross(unit, n), unit, n};
  }
};
using Frame = FrameOf<double>;

// Directions in the local frame.
inline double cos_theta(const Vec3& w) { return w.z; }
inline double abs_cos_theta(const Vec3& w) { return std::abs(w.z); }
inline double sin2_theta(const Vec3& w) { return w.x * w.x + w.y * w.y; }
inline bool same_side(const Vec3& a, const Vec3& b) { return a.z * b.z > 0; }

template <class F>
Vec3Of<F> reflect(const Vec3Of<F>& w) {
  return {-w.x, -w.y, w.z};
}
template <class F>
Vec3Of<F> reflect(const Vec3Of<F>& w, const Vec3Of<F>& h) {
  return F(2) * dot(w, h) * h - w;
}

}  // namespace mlt
