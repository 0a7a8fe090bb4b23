// A vertex of a light path, and its factors in the path's terms. The ends are vertices like any
// other: the terms of a path are formed without regard to the kinds of its vertices.
#pragma once

#include "scene/bsdf/bsdf_at.h"

namespace mlt {

/// `inner` vertices scatter light, on a surface or in a medium.
enum class VertexKind : uint8_t { light, inner, camera };

/// A small value without pointers: it can be stored and read back in another process.
struct Vertex {
  VertexKind kind = VertexKind::inner;
  /// Lobe of its scattering: smooth, or one of the deltas. Lights that shine in one direction alone
  /// have `reflection`.
  Lobe lobe = Lobe::smooth;
  uint32_t emitter = 0;  ///< For a light vertex: position in Scene::emitters().
  SurfacePoint at;

  bool delta() const { return lobe != Lobe::smooth; }
};

/// The factors that one vertex contributes to a path through `towards_light` and `towards_camera`.
///
/// `f` is the scattering factor f_i of the measurement contribution (Veach 1997, eq. 8.7): emitted
/// radiance at x_0, the BSDF in between, importance at x_k; in a medium sigma_s times the phase
/// function. The densities are coefficients in projected solid angle at this vertex (in a medium,
/// in solid angle), of having sampled the next vertex from the light or from the camera; times G
/// they are densities in the measure of the next vertex.
///
/// With a shading normal ns beside the geometric one ng, f = f_s |wl.ns| / |wl.ng| (Veach 1997,
/// sec. 5.3.2), so f is the same for walks from both ends.
///
/// At a delta vertex all three are coefficients of ONE delta, in the projected solid angle of the
/// camera-side direction: f = F, pdf_from_light = P_l, pdf_from_camera = P_c (eta_l / eta_c)^2,
/// where f and pdf_from_camera also carry S = |wl.ns| |wc.ng| / (|wc.ns| |wl.ng|), which is 1
/// without shading normals.
struct VertexTerms {
  Spectrum f{0};
  double pdf_from_light = 0;
  double pdf_from_camera = 0;
  bool disperses = false;  ///< See Scattering.
};

/// The terms of an end vertex. x_0 has no wl and x_k no wc; they are ignored.
VertexTerms end_terms(const Scene& scene, const Vertex& x, const Vec3& wl, const Vec3& wc);
/// The terms of x_k, and the raster position of the path; nullopt if it misses the image.
struct LensTerms {
  VertexTerms vertex;
  std::optional<Vec2> raster;
};
LensTerms lens_terms(const Scene& scene, const SurfacePoint& xk, const Vec3& wl);

/// The terms of a surface vertex that scatters by a delta lobe.
VertexTerms delta_terms(const Scene& scene, const SurfacePoint& at, Lobe lobe, const Vec3& wl,
                        const Vec3& wc);
/// The terms of an inner vertex that scatters by `lobe`.
inline VertexTerms inner_terms(const Scene& scene, const SurfacePoint& at, Lobe lobe,
                               const Vec3& wl, const Vec3& wc, bool strict_normals) {
  const double geometric_l = abs_cos(at, wl), geometric_c = abs_cos(at, wc);
  if (geometric_l == 0 || geometric_c == 0) return {};
  if (!(consistent_sides(at, wl, strict_normals) && consistent_sides(at, wc, strict_normals)))
    return {};
  if (lobe != Lobe::smooth) return delta_terms(scene, at, lobe, wl, wc);
  const WorldScattering s = BsdfAt(scene, at).scattering(wl, wc, lobe);
  return {s.f * (std::abs(s.cos_l) / geometric_l), s.pdf_from_light / geometric_c,
          s.pdf_from_camera / geometric_l, s.disperses};
}

/// The part of an edge along w in the terms of a Lambertian vertex (VertexTerms), in double
/// precision or in the single precision of waves.
template <class F>
struct LambertianEdge {
  F geometric;    ///< |w.ng|
  F quotient;     ///< |w.ns| / |w.ng|
  bool scatters;  ///< Whether light is scattered between w and the previous vertex.

  /// The density of w in projected solid angle.
  double density() const { return quotient * inv_pi; }
};
/// `cosine` is that of the direction to the previous vertex with ns; 0: nothing is scattered.
template <class F>
LambertianEdge<F> lambertian_edge(const Vec3Of<F>& ng, const Vec3Of<F>& ns, const Vec3Of<F>& w,
                                  F cosine, bool strict_normals) {
  const F geometric = std::abs(dot(ng, w)), shading = dot(ns, w);
  const bool consistent = consistent_sides(ng, ns, w, strict_normals);
  const bool scatters = (shading * cosine > 0) & (geometric > 0) & consistent;
  return {geometric, std::abs(shading) / geometric, scatters};
}

/// Terms of a vertex with the unit directions `wl` to the vertex on its light side and `wc` to the
/// one on its camera side.
inline VertexTerms vertex_terms(const Scene& scene, const Vertex& x, const Vec3& wl, const Vec3& wc,
                                bool strict_normals) {
  if (x.kind != VertexKind::inner) return end_terms(scene, x, wl, wc);
  return inner_terms(scene, x.at, x.lobe, wl, wc, strict_normals);
}
/// Terms of a vertex at which a path is joined, whatever its lobe: it scatters smoothly there, if
/// it can.
inline VertexTerms joint_terms(const Scene& scene, const Vertex& x, const Vec3& wl, const Vec3& wc,
                               bool strict_normals) {
  if (x.kind == VertexKind::light && x.delta()) return {};
  if (x.kind != VertexKind::inner) return end_terms(scene, x, wl, wc);
  return inner_terms(scene, x.at, Lobe::smooth, wl, wc, strict_normals);
}

/// Density with which a light walk starts at x_0, the choice of the light included.
double light_position_pdf(const Scene& scene, const Vertex& x0);
/// Density with which next-event estimation at `from` samples x_0.
double direct_position_pdf(const Scene& scene, const Vertex& x0, const SurfacePoint& from);
/// Density with which a camera walk starts at x_k.
double camera_position_pdf(const Scene& scene, const Vertex& xk);

/// Whether a walk from the other end can hit this end vertex and find light: not a point or
/// directional light, not one that shines in one direction alone, not a pinhole.
bool can_be_hit(const Scene& scene, const Vertex& end);
/// Whether an edge may be made by connection at this vertex.
inline bool connectable(const Vertex& x) { return !x.delta(); }

inline Vertex light_vertex(const Emitter& emitter, const SurfacePoint& at) {
  const Lobe lobe = emitter.delta_direction() ? Lobe::reflection : Lobe::smooth;
  return {VertexKind::light, lobe, emitter.index(), at};
}
inline Vertex camera_vertex(const SurfacePoint& at) {
  return {VertexKind::camera, Lobe::smooth, 0, at};
}
inline Vertex inner_vertex(const SurfacePoint& at, Lobe lobe = Lobe::smooth) {
  return {VertexKind::inner, lobe, 0, at};
}

}  // namespace mlt
