// The vertices of some samples at one place of their subpaths, and their connection with those of
// another place: in loops without branches, which the compiler vectorises.
// Directions and cosines are in single precision, throughputs and densities in double.
#pragma once

#include "math/spectrum.h"
#include "wave/lambertian_vertices.h"

namespace mlt {

/// The fourth lane of an RGB scene is left out.
struct SpectrumLanes {
  static constexpr int size = 8;
  Lanes<double, size> lane[Spectrum::lanes];

  Spectrum get(int i, int lanes) const {
    return {lane[0][i], lane[1][i], lane[2][i], lane[lanes == 4 ? 3 : 1][i]};
  }
  void set(int i, const Spectrum& s) {
    for (int j = 0; j < Spectrum::lanes; ++j) lane[j][i] = s[j];
  }
};

/// The terms that all joints of a vertex have in common. A point on a light is a vertex too, with
/// ng for n.
struct JointLanes {
  static constexpr int size = SpectrumLanes::size;
  VectorLanes<size> p, ng, n;
  Lanes<float, size> extent;
  /// Cosine of the direction to the previous vertex with n; 0: no path is joined here.
  Lanes<float, size> cosine;
  SpectrumLanes value;          ///< See WalkVertex::Joint::value.
  Lanes<double, size> forward;  ///< Density of the vertex, made by its walk.
  /// Sum of r_i^beta over the techniques with a joint before the vertex or at it (TechniqueSums).
  Lanes<double, size> sums;
  Lanes<double, size> survival;  ///< Probability that its walk has survived Russian roulette.
};

/// Shadow rays between the vertices of a joint.
struct JoiningRays {
  VectorLanes<JointLanes::size> o, w;
  Lanes<float, JointLanes::size> length;  ///< 0: no light goes that way.
};

/// Joins vertices of light subpaths to those of camera subpaths; `own` is r^beta of the technique
/// that does (TechniqueSums), and `weighted` is f w / p, in the first `lanes` lanes. The results
/// are two parameters that do not overlap, so that the compiler vectorises the loops.
inline void join(const JointLanes& from_light, const JointLanes& from_camera,
                 const Lanes<double, JointLanes::size>& own, bool strict, const MisExponent& beta,
                 int lanes, JoiningRays& __restrict rays, SpectrumLanes& __restrict weighted) {
  const JointLanes &a = from_light, &b = from_camera;
  Lanes<double, JointLanes::size> share;
  for (int i = 0; i < JointLanes::size; ++i) {
    const Vec3f between = b.p[i] - a.p[i];
    const float distance2 = dot(between, between);
    const Vec3f w = between * (1 / std::sqrt(distance2));
    const auto at_a = lambertian_edge(a.ng[i], a.n[i], w, a.cosine[i], strict);
    const auto at_b = lambertian_edge(b.ng[i], b.n[i], -w, b.cosine[i], strict);
    const double G = double{at_a.geometric} * at_b.geometric / distance2;
    const double below = beta.over(a.sums[i], at_b.quotient * inv_pi * G / a.forward[i]);
    const double above = beta.over(b.sums[i], at_a.quotient * inv_pi * G / b.forward[i]);
    share[i] = at_b.quotient * G * own[i] / (own[i] + below + above);
    const Vec3f start = ray_origin(a.p[i], a.ng[i], w, a.extent[i]);
    const Vec3f ray = ray_origin(b.p[i], b.ng[i], -w, b.extent[i]) - start;
    const float length = std::sqrt(dot(ray, ray));
    rays.o.set(i, start);
    rays.w.set(i, ray * (1 / length));
    rays.length[i] =
        at_a.scatters & at_b.scatters ? length * static_cast<float>(1 - ray_offset) : 0;
  }
  for (int j = 0; j < lanes; ++j)
    for (int i = 0; i < JointLanes::size; ++i)
      weighted.lane[j][i] = a.value.lane[j][i] * b.value.lane[j][i] * share[i];
}

}  // namespace mlt
