// The constraint at a (nearly) specular vertex between its two neighbours, and its derivatives by
// the positions of the three (Jakob & Marschner 2012, "Manifold exploration", sec. 4.1).
//
// With the directions wl and wc to the neighbour on the light side and on the camera side, and eta
// = eta_l / eta_c (1 for reflection), eta wl + wc lies along the normal about which light is
// reflected or refracted. The constraint g is its part across the shading normal n:
//
//   at a delta      g = (eta wl + wc) . (s, t)  = 0
//   otherwise       g = h . (s, t)  is constant, with h = +-(eta wl + wc) / |eta wl + wc|
//
// where s and t are functions of n alone, so that they turn with it in a known way.
#pragma once

#include "math/frame.h"
#include "path/vertex.h"

#include <glm/mat2x2.hpp>

#include <optional>

namespace mlt {

using Mat2 = glm::dmat2;

/// The derivative of a point of the plane by a point in space: one row for each component.
struct PlaneByPoint {
  Vec3 s{0}, t{0};

  Vec2 operator*(const Vec3& move) const { return {dot(s, move), dot(t, move)}; }
  /// The derivative by coordinates in the plane of f.s and f.t.
  Mat2 along(const Frame& f) const { return {*this * f.s, *this * f.t}; }
};

inline PlaneByPoint operator*(const Mat2& m, const PlaneByPoint& d) {
  return {m[0][0] * d.s + m[1][0] * d.t, m[0][1] * d.s + m[1][1] * d.t};
}

/// How light is scattered at a vertex of a specular chain.
struct SpecularScattering {
  bool delta = true, reflected = false;
  bool front = false;  ///< Whether the light side is in front of the surface, as n points.
  Vec2 g{0};           ///< The constraint's value.
};

struct SpecularConstraint {
  Vec2 g{0};
  PlaneByPoint before, own, after;  ///< Derivatives by the vertices, from the light side on.
  /// At a delta |dg / d omega_c| by projected solid angle about the geometric normal, else 1.
  double per_direction = 1;
};

/// The constraint at `own`; nullopt where it is not differentiable.
std::optional<SpecularConstraint> specular_constraint(const Scene& scene,
                                                      const SurfacePoint& before, const Vertex& own,
                                                      const SurfacePoint& after);

/// How light is scattered at `own`, which a walk keeps.
std::optional<SpecularScattering> specular_scattering(const Scene& scene,
                                                      const SurfacePoint& before, const Vertex& own,
                                                      const SurfacePoint& after);

/// The direction in which light from wl is scattered; nullopt if there is none.
std::optional<Vec3> scattered_direction(const Scene& scene, const Vertex& own,
                                        const SpecularScattering& scattering, const Vec3& wl);

/// Whether constraints can be formed for this vertex, if it is specular: where images bend the
/// shading normal, how it turns is not known, and manifold walks go through the surfaces that
/// light passes.
inline bool has_constraint(const Scene& scene, const Vertex& x) {
  const Bsdf& bsdf = scene.bsdf(x.at);
  return !bsdf.bends_normal() && !bsdf.has_passage();
}

}  // namespace mlt
