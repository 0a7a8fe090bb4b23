// A vertex of a light path, and what it contributes to the path's terms. The ends are vertices like
// any other; this file is the only one that asks which kind a vertex is.
#pragma once

#include "scene/scene.h"

namespace mlt {

enum class VertexKind : uint8_t { light, surface, camera };

/// A small value without pointers: it can be stored and read back in another process.
struct Vertex {
  VertexKind kind = VertexKind::surface;
  Lobe lobe = Lobe::smooth;  ///< How it scatters: by a density, or by which delta.
  uint32_t emitter = 0;      ///< For a light vertex: position in Scene::emitters().
  SurfacePoint at;

  bool delta() const { return lobe != Lobe::smooth; }
};

/// Light leaks through or vanishes where the geometric and the shading normal see a direction on
/// different sides. By default the shading normal alone decides; `strict` refuses such directions.
inline bool consistent_sides(const SurfacePoint& at, const Vec3& w, bool strict) {
  return !strict || dot(at.ng, w) * dot(at.shading.n, w) > 0;
}

/// The factors that one vertex contributes to a path through `towards_light` and `towards_camera`.
///
/// `f` is the scattering factor f_i of the measurement contribution (Veach 1997, eq. 8.7): emitted
/// radiance at x_0, the BSDF in between, importance at x_k. The densities are coefficients in
/// projected solid angle at this vertex, of having sampled the next vertex from the light or from
/// the camera; times G they are densities in the measure of the next vertex.
///
/// With a shading normal ns beside the geometric one ng, f = f_s |wl.ns| / |wl.ng| (Veach 1997,
/// sec. 5.3.2), so the same f serves walks from both ends.
///
/// At a delta vertex all three are coefficients of ONE delta, in the projected solid angle of the
/// camera-side direction: f = F, pdf_from_light = P_l, pdf_from_camera = P_c (eta_l / eta_c)^2,
/// where f and pdf_from_camera also carry S = |wl.ns| |wc.ng| / (|wc.ns| |wl.ng|), which is 1
/// without shading normals.
struct VertexTerms {
  Color f{0};
  double pdf_from_light = 0;
  double pdf_from_camera = 0;
};

/// Terms of a vertex with the unit directions `wl` to the vertex on its light side and `wc` to the
/// one on its camera side; x_0 has no wl and x_k no wc, they are not looked at.
VertexTerms vertex_terms(const Scene& scene, const Vertex& x, const Vec3& wl, const Vec3& wc,
                         bool strict_normals);
/// The same for x_k, and where the path meets the image; nullopt if it does not.
struct LensTerms {
  VertexTerms vertex;
  std::optional<Vec2> raster;
};
LensTerms lens_terms(const Scene& scene, const SurfacePoint& xk, const Vec3& wl);
/// Terms of a vertex at which a path is joined, whatever its lobe: it scatters smoothly there.
VertexTerms joint_terms(const Scene& scene, const Vertex& x, const Vec3& wl, const Vec3& wc,
                        bool strict_normals);
/// The same for a surface vertex that scatters by `lobe`.
VertexTerms surface_terms(const Scene& scene, const SurfacePoint& at, Lobe lobe, const Vec3& wl,
                          const Vec3& wc, bool strict_normals);

/// Density with which a light walk starts at x_0, the choice of the light included.
double light_position_pdf(const Scene& scene, const Vertex& x0);
/// Density with which next-event estimation at `from` chooses x_0.
double direct_position_pdf(const Scene& scene, const Vertex& x0, const SurfacePoint& from);
/// Density with which a camera walk starts at x_k.
double camera_position_pdf(const Scene& scene, const Vertex& xk);

/// Whether a walk from the other end can arrive at this end vertex: not at a point or directional
/// light, not at a pinhole.
bool can_be_hit(const Scene& scene, const Vertex& end);
/// Whether an edge may be made by connection at this vertex.
inline bool connectable(const Vertex& x) { return !x.delta(); }

Vertex light_vertex(const Emitter& emitter, const SurfacePoint& at);
Vertex camera_vertex(const SurfacePoint& at);
Vertex surface_vertex(const SurfacePoint& at, Lobe lobe = Lobe::smooth);

}  // namespace mlt
