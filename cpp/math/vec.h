// The vector types. Paths, their terms and densities are in double precision; Lambertian vertices
// of waves are in single precision, and meshes, textures and images store floats.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mlt {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat3 = glm::dmat3;
using Mat4 = glm::dmat4;  // column-major: m[column][row]
using Vec2i = glm::ivec2;
using Vec2f = glm::vec2;
using Vec3f = glm::vec3;
/// For formulas of double precision and of the single precision of waves.
template <class F>
using Vec2Of = glm::vec<2, F>;
template <class F>
using Vec3Of = glm::vec<3, F>;

using glm::cross;
using glm::dot;
using glm::length;
using glm::normalize;

constexpr double pi = 3.14159265358979323846;
constexpr double inv_pi = 1 / pi;
constexpr double degree = pi / 180;
constexpr double infinity = std::numeric_limits<double>::infinity();

template <class F>
F sqr(const F& x) {
  return x * x;
}
inline double safe_sqrt(double x) { return std::sqrt(std::max(0.0, x)); }
inline double length_squared(const Vec3& v) { return dot(v, v); }
inline double max_component(const Vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }
inline double min_component(const Vec3& v) { return std::min(v.x, std::min(v.y, v.z)); }
inline bool is_finite(const Vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether the last row is 0 0 0 1: no perspective.
inline bool is_affine(const Mat4& m) {
  return m[0].w == 0 && m[1].w == 0 && m[2].w == 0 && m[3].w == 1;
}
inline Vec3 transform_point(const Mat4& m, const Vec3& p) {
  const Vec4 q = m * Vec4(p, 1);
  return Vec3(q) / q.w;
}
inline Vec3 transform_vector(const Mat4& m, const Vec3& v) { return Mat3(m) * v; }
/// A normal moves with the inverse transpose; `inverse` is the inverse of the point transform.
inline Vec3 transform_normal(const Mat4& inverse, const Vec3& n) {
  return glm::transpose(Mat3(inverse)) * n;
}

}  // namespace mlt
