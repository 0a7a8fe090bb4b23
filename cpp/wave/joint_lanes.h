// The vertices of some samples at one place of their subpaths, and their connection with those of
// another place: in loops without branches, which the compiler vectorises.
// Directions and cosines are in single precision, throughputs and densities in double.
#pragma once

#include "math/spectrum.h"
#include "wave/lambertian_vertices.h"
#include "wave/single_walk_vertex.h"

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
/// ng for n. Single vertices have no more than their position, whether they can be joined (by
/// `cosine`), the density and the survival.
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
  Lanes<double, size> survival;     ///< Probability that its walk has survived Russian roulette.
  Lanes<bool, size> dispersed;      ///< Whether a vertex before it disperses.
  Lanes<MediumIndex, size> medium;  ///< In which rays leave it.
  Lanes<const SingleWalkVertex*, size>
      single;  ///< nullptr: it is Lambertian, or on an emissive mesh.
};

/// The position of a vertex: that in double precision, where it is known.
inline Vec3 position(const JointLanes& lanes, int i) {
  return lanes.single[i] ? lanes.single[i]->x.vertex.at.p : Vec3(lanes.p[i]);
}

/// What joints with some technique have in common on their light side.
struct JointTechnique {
  Lanes<double, JointLanes::size> own;  ///< Its r^beta (TechniqueSums).
  /// The density of a direction from the vertex there in projected solid angle, without
  /// |w.ns| / |w.ng|: 1 / pi but for lights at infinity.
  Lanes<double, JointLanes::size> onwards;
  /// 0 if that vertex is at infinity, else 1. Then its position is the direction towards it, which
  /// its normals oppose.
  Lanes<float, JointLanes::size> near;
};

/// The vertex of a lane as one of a single walk: that in double precision, or what `scratch` then
/// holds, which is a point of this kind.
inline const WalkVertex& single_vertex(const JointLanes& lanes, int i, PointKind kind,
                                       WalkVertex& scratch) {
  if (lanes.single[i]) return lanes.single[i]->x;
  SurfacePoint& at = scratch.vertex.at;
  at.kind = kind;
  at.p = Vec3(lanes.p[i]);
  at.ng = Vec3(lanes.ng[i]);
  at.shading.n = Vec3(lanes.n[i]);
  at.extent = lanes.extent[i];
  at.shape = SurfacePoint::unknown_shape;
  scratch.dispersed = lanes.dispersed[i];
  scratch.joint.known = true;
  scratch.joint.cosine = lanes.cosine[i];
  for (int j = 0; j < Spectrum::lanes; ++j) scratch.joint.value[j] = lanes.value.lane[j][i];
  return scratch;
}

/// The arrival at the vertex of a walk along w, without what lies on the way. Light passes neither
/// Lambertian meshes nor emissive ones, and points at infinity are no surfaces.
inline Arrival arrival(const Scene& scene, const JointLanes& lanes, int i, const Vec3& w) {
  return lanes.single[i] ? scene.arrival({}, lanes.single[i]->x.vertex.at, w) : Arrival();
}
/// The medium in which a ray leaves the vertex along w.
inline MediumIndex medium_towards(const Scene& scene, const JointLanes& lanes, int i,
                                  const Vec3& w) {
  return lanes.single[i] ? scene.medium_towards(lanes.single[i]->x.vertex.at, w) : lanes.medium[i];
}

/// Shadow rays between the vertices of a joint.
struct JoiningRays {
  VectorLanes<JointLanes::size> o, w;
  Lanes<float, JointLanes::size> length;  ///< 0: no light goes that way.
  /// The sums over the techniques that do not join here (TechniqueSums).
  Lanes<double, JointLanes::size> others;
};

/// Joins vertices of light subpaths to those of camera subpaths; `weighted` is f w / p, in the
/// first `lanes` lanes. The results are two parameters that do not overlap, so that the compiler
/// vectorises the loops.
inline void join(const JointLanes& from_light, const JointLanes& from_camera,
                 const JointTechnique& technique, bool strict, const MisExponent& beta, int lanes,
                 JoiningRays& __restrict rays, SpectrumLanes& __restrict weighted) {
  const JointLanes &a = from_light, &b = from_camera;
  Lanes<double, JointLanes::size> share;
  for (int i = 0; i < JointLanes::size; ++i) {
    const Vec3f between = b.p[i] * technique.near[i] - a.p[i];
    const float distance2 = dot(between, between);
    const Vec3f w = between * (1 / std::sqrt(distance2));
    const auto at_a = lambertian_edge(a.ng[i], a.n[i], w, a.cosine[i], strict);
    const auto at_b = lambertian_edge(b.ng[i], b.n[i], -w, b.cosine[i], strict);
    const double G = double{at_a.geometric} * at_b.geometric / distance2;
    const double below = beta.over(a.sums[i], at_b.density() * G / a.forward[i]);
    const double above =
        beta.over(b.sums[i], at_a.quotient * technique.onwards[i] * G / b.forward[i]);
    const double own = technique.own[i];
    rays.others[i] = (below + above) / own;
    share[i] = at_b.quotient * G * mis_weight(own, below, above);
    const Vec3f start = ray_origin(a.p[i], a.ng[i], w, a.extent[i]);
    const Vec3f ray = ray_origin(b.p[i], b.ng[i], -w, b.extent[i]) - start;
    const float length = std::sqrt(dot(ray, ray));
    rays.o.set(i, start);
    rays.w.set(i, ray * (1 / length));
    rays.length[i] =
        (at_a.scatters & at_b.scatters) ? length * static_cast<float>(1 - ray_offset) : 0;
  }
  for (int j = 0; j < lanes; ++j)
    for (int i = 0; i < JointLanes::size; ++i)
      weighted.lane[j][i] = a.value.lane[j][i] * b.value.lane[j][i] * share[i];
}

}  // namespace mlt
