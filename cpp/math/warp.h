// Warps from the unit square to the domains that rendering integrates over. Each is a triple:
// sample_x(u) maps uniform numbers in [0,1) to a point, x_pdf(point) is its density with respect to
// length, area or solid angle, and invert_x(point) returns the numbers that sample_x maps to it.
// Directions are in the local frame (z is the axis). Angles are measured in turns, so that u is
// used exactly; sine and cosine are the only transcendental functions on the sampling side.
#pragma once

#include "math/frame.h"
#include "math/number.h"
#include "math/polynomial.h"

#include <cstdint>

namespace mlt {

template <class F>
struct SinCosOf {
  F sin, cos;
};
using SinCos = SinCosOf<double>;

namespace detail {

/// sin and cos of x for |x| <= pi/4, by their Taylor series: in double precision to 1 ulp
/// (x^17 / 17! < 5e-17), in single precision to 4e-7 (x^9 / 9!).
template <class F>
SinCosOf<F> sincos_octant(const F& x) {
  const F y = x * x;
  if constexpr (is_double<F>) {
    const F s = polynomial(y, {F(-1. / 1307674368000), F(1. / 6227020800), F(-1. / 39916800),
                               F(1. / 362880), F(-1. / 5040), F(1. / 120), F(-1. / 6)});
    const F c = polynomial(y, {F(1. / 20922789888000), F(-1. / 87178291200), F(1. / 479001600),
                               F(-1. / 3628800), F(1. / 40320), F(-1. / 720), F(1. / 24), F(-0.5)});
    return {x + x * y * s, 1 + y * c};
  } else {
    const F s = polynomial(y, {F(-1.f / 5040), F(1.f / 120), F(-1.f / 6)});
    const F c = polynomial(y, {F(1.f / 40320), F(-1.f / 720), F(1.f / 24), F(-0.5f)});
    return {x + x * y * s, 1 + y * c};
  }
}

}  // namespace detail

/// sin and cos of 2 pi u for |u| < 2^30: the quarter turns are removed from u exactly.
/// Without branches, so that loops over it are vectorised.
template <class F>
SinCosOf<F> sincos_turns(const F& u) {
  const F quarter = nearbyint(4 * u);
  const SinCosOf<F> a = detail::sincos_octant(number<F>(2 * pi) * (u - number<F>(0.25) * quarter));
  const F k = quarter - 4 * floor(number<F>(0.25) * quarter);
  const auto odd = (k == 1) | (k == 3);
  const F s = select(odd, a.cos, a.sin), c = select(odd, a.sin, a.cos);
  return {select(k >= 2, -s, s), select((k == 1) | (k == 2), -c, c)};
}

/// atan2(y, x) in turns, to 3e-16 of itself and without branches. With t = tan(a - pi/4) or tan(a),
/// |t| <= tan(pi/8), a is t times a polynomial in t^2 that was fitted to 6e-18 (Chebyshev nodes).
template <class F>
F signed_turns(const F& x, const F& y) {
  const F tan_pi_8 = number<F>(0.41421356237309503);
  const F less = min(abs(x), abs(y)), more = max(abs(x), abs(y));
  const auto beyond = less > tan_pi_8 * more;
  const F above = select(beyond, less - more, less), below = select(beyond, less + more, more);
  const F t = above / select(below > 0, below, F(1)), y2 = t * t;
  const F p =
      polynomial(y2, {F(-0.0030520961421563173), F(0.0062439121507638935), F(-0.00809374456969308),
                      F(0.009323533555664051), F(-0.010606899399966464), F(0.01224248977977944),
                      F(-0.01446862400784712), F(0.017683882413208465), F(-0.0227364204400318),
                      F(0.03183098861837194), F(-0.05305164769729844)});
  const F in_octant =
      t * number<F>(0.5 * inv_pi) + t * y2 * p + select(beyond, number<F>(0.125), F(0));
  const F in_quarter = select(abs(y) > abs(x), number<F>(0.25) - in_octant, in_octant);
  return copysign(select(x < 0, number<F>(0.5) - in_quarter, in_quarter), y);
}

/// The inverse of sincos_turns: the azimuth of (x, y) in turns, in [0, 1).
inline double turns(double x, double y) {
  const double t = signed_turns(x, y);
  return t < 0 ? std::min(t + 1, 1 - 0x1p-53) : t;
}

namespace detail {

template <class F>
struct DiskPoint {
  Vec2Of<F> p;
  F r;  ///< The radius, or its negative.
};

/// Without branches, so that loops over it are vectorised.
template <class F>
DiskPoint<F> concentric(const Vec2Of<F>& u) {
  const F a = 2 * u.x - 1, b = 2 * u.y - 1;
  const auto wide = abs(a) > abs(b);
  const F r = select(wide, a, b), other = select(wide, b, a);
  const SinCosOf<F> angle = sincos_octant(number<F>(pi / 4) * select(r == 0, F(0), other / r));
  return {{r * select(wide, angle.cos, angle.sin), r * select(wide, angle.sin, angle.cos)}, r};
}

}  // namespace detail

// The unit disk, by the concentric map (Shirley & Chiu 1997, "A low distortion map between disk and
// square"): four triangles of the square become four quarters of the disk.

inline Vec2 sample_disk(const Vec2& u) { return detail::concentric(u).p; }

inline double disk_pdf() { return inv_pi; }

inline Vec2 invert_disk(const Vec2& p) {
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const double radius = std::min(1.0, std::sqrt(p.x * p.x + p.y * p.y));
  if (radius == 0) return {0.5, 0.5};
  const double r = std::copysign(radius, wide ? p.x : p.y);
  const double other = r * (4 * inv_pi) * std::atan(wide ? p.y / p.x : p.x / p.y);
  const Vec2 ab = wide ? Vec2(r, other) : Vec2(other, r);
  return {0.5 * ab.x + 0.5, 0.5 * ab.y + 0.5};
}

// The hemisphere with density cos / pi: the disk, lifted (Malley's method; Pharr et al., PBRT 3rd
// ed., sec. 13.6.3).

template <class F>
Vec3Of<F> sample_cosine_hemisphere(const Vec2Of<F>& u) {
  const auto [p, r] = detail::concentric(u);
  return {p.x, p.y, sqrt((1 - r) * (1 + r))};
}

inline double cosine_hemisphere_pdf(const Vec3& w) { return w.z > 0 ? w.z * inv_pi : 0; }

inline Vec2 invert_cosine_hemisphere(const Vec3& w) { return invert_disk({w.x, w.y}); }

// The whole sphere: by Archimedes, z is uniform.

inline Vec3 sample_uniform_sphere(const Vec2& u) {
  const double r = 2 * std::sqrt(u.x * (1 - u.x));
  const SinCos phi = sincos_turns(u.y);
  return {r * phi.cos, r * phi.sin, 1 - 2 * u.x};
}

inline double uniform_sphere_pdf() { return 0.25 * inv_pi; }

inline Vec2 invert_uniform_sphere(const Vec3& w) { return {0.5 * (1 - w.z), turns(w.x, w.y)}; }

// The spherical cap of directions with 1 - cos <= `height`; height = 1 is the hemisphere. The
// height (not the cosine) is the parameter, so that narrow cones keep their digits.

inline Vec3 sample_cone(const Vec2& u, double height) {
  const double h = u.x * height;
  const double r = std::sqrt(h * (2 - h));
  const SinCos phi = sincos_turns(u.y);
  return {r * phi.cos, r * phi.sin, 1 - h};
}

inline double cone_pdf(double height) { return 1 / (2 * pi * height); }

inline double cone_pdf(const Vec3& w, double height) {
  return 1 - w.z <= height ? cone_pdf(height) : 0;
}

inline Vec2 invert_cone(const Vec3& w, double height) {
  const double h = w.z > 0 ? sin2_theta(w) / (1 + w.z) : 1 - w.z;  // 1 - cos without cancellation
  return {std::min(h / height, 1 - 0x1p-53), turns(w.x, w.y)};
}

// A lobe cos^n about the z axis, as in the Phong model (Lafortune & Willems 1994, "Using the
// modified Phong reflectance model for physically based rendering").

template <class F>
Vec3Of<F> sample_cosine_power(const Vec2Of<F>& u, F n) {
  const F sin2 = for_each_lane<F>(
      [&](int i) { return -std::expm1(2 / (lane_of(n, i) + 1) * std::log1p(-lane_of(u.x, i))); });
  const SinCosOf<F> phi = sincos_turns(u.y);
  const F r = sqrt(sin2);
  return {r * phi.cos, r * phi.sin, sqrt(1 - sin2)};
}

inline double cosine_power_pdf(const Vec3& w, double n) {
  return w.z > 0 ? (n + 1) * (0.5 * inv_pi) * std::pow(w.z, n) : 0;
}

inline Vec2 invert_cosine_power(const Vec3& w, double n) {
  // cos^(n+1) = exp((n+1)/2 log(1 - sin^2)): accurate also for narrow lobes.
  const double tail =
      w.z > 0 ? std::expm1(0.5 * (n + 1) * std::log1p(-std::min(1.0, sin2_theta(w)))) : -1;
  return {std::min(-tail, 1 - 0x1p-53), turns(w.x, w.y)};
}

// A lobe cos^n about any unit axis.

template <class F>
Vec3Of<F> sample_lobe(const Vec2Of<F>& u, const Vec3Of<F>& axis, F n) {
  return FrameOf<F>::around(axis).to_world(sample_cosine_power(u, n));
}

inline double lobe_pdf(const Vec3& w, const Vec3& axis, double n) {
  return cosine_power_pdf({0, 0, dot(w, axis)}, n);
}

inline Vec2 invert_lobe(const Vec3& w, const Vec3& axis, double n) {
  return invert_cosine_power(Frame::around(axis).to_local(w), n);
}

// Barycentric coordinates (b1, b2) uniform in a triangle; b0 = 1 - b1 - b2 (Heitz 2019, "A
// low-distortion map between triangle and square"). Divide by the area for a density on a surface.

inline Vec2 sample_triangle(const Vec2& u) { return u - 0.5 * std::min(u.x, u.y); }

inline double triangle_pdf() { return 2; }

inline Vec2 invert_triangle(const Vec2& b) {
  if (b.y > b.x) return {2 * b.x, b.y + b.x};
  return {b.x + b.y, 2 * b.y};
}

}  // namespace mlt
