// The constraints of a chain of specular vertices between two given ends: a block tridiagonal
// system, of 2 x 2 blocks, in the positions of the vertices on their surfaces (Jakob & Marschner
// 2012, sec. 4.2).
#pragma once

#include "path/specular_constraint.h"

#include <array>

namespace mlt {

class SpecularChain {
 public:
  static constexpr int most_vertices = 12;

  /// The chain of `count` vertices, and the two ends before the first and after the last of them:
  /// on the light side and on the camera side. `vertices` points to the end on the light side.
  SpecularChain(const Scene& scene, const Vertex* vertices, int count);

  /// abs(det(d g / d x)) by areas of the vertices, over |dg / d omega_c| of each delta: the density
  /// of the vertices, given the ends, in the measure in which f has its delta coefficients. 0 where
  /// they are not determined.
  double density() const { return density_; }

  /// How the first vertex moves when the end on the camera side does.
  Vec3 first_move(const Vec3& end_move) const;

 private:
  double density_ = 1;
  Frame tangents_{};     ///< Tangents at the first vertex.
  PlaneByPoint by_end_;  ///< Derivative of the first vertex by the camera end, in tangents_.
};

}  // namespace mlt
