// What formulas are written over: double for single paths, and Float8 for eight of them side by
// side. A formula that is to serve both chooses by select(), and not by a branch.
#pragma once

#include "math/vec.h"

#include <experimental/simd>
#include <type_traits>

namespace mlt {

namespace stdx = std::experimental;
using Float8 = stdx::simd<float, stdx::simd_abi::deduce_t<float, 8>>;

template <class F>
inline constexpr bool is_number = std::is_floating_point_v<F>;

/// A number in all lanes.
template <class F>
F number(double x) {
  if constexpr (is_number<F>)
    return static_cast<F>(x);
  else
    return F(static_cast<float>(x));
}

inline double select(bool condition, double a, double b) { return condition ? a : b; }
inline float select(bool condition, float a, float b) { return condition ? a : b; }
inline Float8 select(const Float8::mask_type& condition, const Float8& a, Float8 b) {
  stdx::where(condition, b) = a;
  return b;
}

/// A number in [0, 1) in single precision, below 1 as well.
inline float below_one(double u) { return std::min(static_cast<float>(u), 0x1.fffffep-1f); }

/// get(i) for each lane i of F; a number has one.
template <class F, class Get>
F for_each_lane(Get&& get) {
  if constexpr (is_number<F>)
    return get(0);
  else
    return F([&](auto i) { return static_cast<float>(get(int(i))); });
}
inline double lane_of(double x, int) { return x; }
inline float lane_of(const Float8& x, int i) { return x[i]; }

// Functions of numbers, for formulas over both kinds:
using std::abs;
using std::copysign;
using std::floor;
using std::max;
using std::min;
using std::nearbyint;
using std::sqrt;

/// x^y.
template <class F>
F power(const F& x, const F& y) {
  return for_each_lane<F>([&](int i) { return std::pow(lane_of(x, i), lane_of(y, i)); });
}

inline Vec3Of<Float8> select(const Float8::mask_type& condition, const Vec3Of<Float8>& a,
                             const Vec3Of<Float8>& b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

// Vectors of eight directions; glm's functions are for numbers alone.
inline Float8 dot(const Vec3Of<Float8>& a, const Vec3Of<Float8>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3Of<Float8> normalize(const Vec3Of<Float8>& v) { return v * (1 / sqrt(dot(v, v))); }

}  // namespace mlt
