// What formulas are written over: double for single paths, and Float8 for eight of them side by
// side, or Double4 where single precision is not enough. A formula for all of them chooses by
// select(), and not by a branch.
#pragma once

#include "math/vec.h"

#include <experimental/simd>
#include <type_traits>

// Vectors of lanes. Those of glm keep their members in unions, where lanes may not be that a
// processor has no register for.
namespace glm {

template <class T, class Abi, qualifier Q>
struct vec<2, std::experimental::simd<T, Abi>, Q> {
  using F = std::experimental::simd<T, Abi>;
  F x, y;

  vec() = default;
  vec(const F& x, const F& y) : x(x), y(y) {}
};

template <class T, class Abi, qualifier Q>
struct vec<3, std::experimental::simd<T, Abi>, Q> {
  using F = std::experimental::simd<T, Abi>;
  F x, y, z;

  vec() = default;
  vec(const F& x, const F& y, const F& z) : x(x), y(y), z(z) {}
};

}  // namespace glm

namespace mlt {

namespace stdx = std::experimental;
using Float8 = stdx::simd<float, stdx::simd_abi::deduce_t<float, 8>>;
using Double4 = stdx::simd<double, stdx::simd_abi::deduce_t<double, 4>>;

template <class F>
inline constexpr bool is_number = std::is_floating_point_v<F>;
template <class F>
using IfLanes = std::enable_if_t<stdx::is_simd_v<F>>;

template <class F, class = void>
struct ValueType {
  using type = F;
};
template <class F>
struct ValueType<F, IfLanes<F>> {
  using type = typename F::value_type;
};
/// Whether F has double precision.
template <class F>
inline constexpr bool is_double = std::is_same_v<typename ValueType<F>::type, double>;

/// A number in all lanes.
template <class F>
F number(double x) {
  if constexpr (is_number<F>)
    return static_cast<F>(x);
  else
    return F(static_cast<typename F::value_type>(x));
}

inline double select(bool condition, double a, double b) { return condition ? a : b; }
inline float select(bool condition, float a, float b) { return condition ? a : b; }
template <class F, class = IfLanes<F>>
inline F select(const typename F::mask_type& condition, const F& a, F b) {
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
    return F([&](auto i) { return static_cast<typename F::value_type>(get(int(i))); });
}
inline double lane_of(double x, int) { return x; }
template <class F, class = IfLanes<F>>
typename F::value_type lane_of(const F& x, int i) {
  return x[i];
}

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

template <class F, class = IfLanes<F>>
inline Vec3Of<F> select(const typename F::mask_type& condition, const Vec3Of<F>& a,
                        const Vec3Of<F>& b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

// Vectors of many directions; glm's functions are for numbers alone.
template <class F, class = IfLanes<F>>
inline F dot(const Vec3Of<F>& a, const Vec3Of<F>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class F, class = IfLanes<F>>
inline Vec3Of<F> normalize(const Vec3Of<F>& v) {
  return v * (1 / sqrt(dot(v, v)));
}

}  // namespace mlt
