// A point where a path has a vertex, and the geometry between two of them.
#pragma once

#include "math/frame.h"
#include "scene/bsdf/lambertian.h"
#include "scene/ray.h"

#include <cstdint>

namespace mlt {

/// The kind of a point, which determines its measure and the cosine at its end of an edge.
enum class PointKind : uint8_t {
  surface,   ///< On a surface (or a lens): the measure is area, the cosine is against `ng`.
  isolated,  ///< A point without a surface (a point light): there is no cosine, it counts as 1.
  medium,    ///< In a medium: the measure is volume; again there is no cosine.
  infinite   ///< At infinity: `p` is the unit direction towards it, the measure is solid angle.
};

/// The place of a solid in Solids; `no_solid` is empty space.
using SolidIndex = uint16_t;
inline constexpr SolidIndex no_solid = 0xffff;
/// Stands in place of what is around a surface that lies in a solid of higher priority.
inline constexpr SolidIndex hidden_surface = 0xfffe;

struct SurfacePoint {
  Vec3 p{0};                  ///< Position; for an infinite point, the unit direction towards it.
  Vec3 ng{0};                 ///< Geometric normal, on the same side as the shading normal.
  Frame shading{};            ///< n: the shading normal; s follows dp/du, unless it is Lambertian.
  Vec2 uv{0};                 ///< Texture coordinates.
  uint32_t shape = no_shape;  ///< Index into Scene::shapes().
  uint32_t primitive = 0;     ///< Triangle of a mesh.
  uint32_t instance = no_shape;  ///< Index of the Instance of the shape, if any.
  PointKind kind = PointKind::surface;
  /// The medium that it is in. At a surface: the one that it was hit or is lit through, which is
  /// that of both sides unless the surface is a boundary (Media).
  MediumIndex medium = no_medium;
  SolidIndex around = no_solid;   ///< On a solid: the one that its surface is in.
  double time = 0;                ///< That of its path.
  double wavelength = rgb_lanes;  ///< That of its path: see wavelengths.h.
  /// Largest coordinate of the primitive: the scale of float rounding in the accelerator.
  double extent = 0;
  Lambertian lambertian{};  ///< Its scattering, if it is Lambertian and was hit by a ray.

  static constexpr uint32_t no_shape = ~0u;
  /// On a surface of which only the point and its normals are known: it has no material to ask.
  static constexpr uint32_t unknown_shape = no_shape - 1;
  bool infinite() const { return kind == PointKind::infinite; }
  bool in_medium() const { return kind == PointKind::medium; }
};

/// A point in a medium.
inline SurfacePoint point_in_medium(const Vec3& p, MediumIndex medium, double time) {
  SurfacePoint at;
  at.p = p;
  at.ng = {0, 0, 1};
  at.shading = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  at.kind = PointKind::medium;
  at.medium = medium;
  at.time = time;
  return at;
}

// Formulas of single paths, in double precision, and of waves, in single precision:

/// Light leaks through or vanishes where a direction is on different sides of the geometric and
/// the shading normal. By default the shading normal alone decides; `strict` rejects them.
template <class F>
bool consistent_sides(const Vec3Of<F>& ng, const Vec3Of<F>& ns, const Vec3Of<F>& w, bool strict) {
  return !strict | (dot(ng, w) * dot(ns, w) > 0);
}
inline bool consistent_sides(const SurfacePoint& at, const Vec3& w, bool strict) {
  return consistent_sides(at.ng, at.shading.n, w, strict);
}

/// How far rays start and end off their surfaces, relative to the largest coordinate of the
/// primitive: 16 units in the last place of the accelerator's floats.
inline constexpr double ray_offset = 0x1p-20;

/// The origin of a ray from p along w (of any length), moved off its surface; `extent` as above.
template <class F>
Vec3Of<F> ray_origin(const Vec3Of<F>& p, const Vec3Of<F>& ng, const Vec3Of<F>& w, F extent) {
  return p + ng * std::copysign(F(ray_offset) * extent, dot(ng, w));
}

/// The unit direction in which `to` is seen from `from`. At most one of the two may be infinite.
inline Vec3 direction(const SurfacePoint& from, const SurfacePoint& to) {
  if (to.infinite()) return to.p;
  if (from.infinite()) return -from.p;
  return normalize(to.p - from.p);
}

/// |cos| between the direction w and the geometric normal; 1 where there is no surface.
inline double abs_cos(const SurfacePoint& at, const Vec3& w) {
  return at.kind == PointKind::surface ? std::abs(dot(at.ng, w)) : 1.0;
}

/// G(a, b), the factor that turns a density in projected solid angle at one end into a density in
/// the measure of the other: |cos a| |cos b| / |a - b|^2 (Veach 1997, eq. 8.2), and |cos b| alone
/// when a is at infinity. Visibility is not part of it.
/// `w` is the direction from a to b.
inline double geometry(const SurfacePoint& a, const SurfacePoint& b, const Vec3& w) {
  const double cosines = abs_cos(a, w) * abs_cos(b, w);
  if (a.infinite() || b.infinite()) return cosines;
  return cosines / length_squared(b.p - a.p);
}
inline double geometry(const SurfacePoint& a, const SurfacePoint& b) {
  return geometry(a, b, direction(a, b));
}

}  // namespace mlt
