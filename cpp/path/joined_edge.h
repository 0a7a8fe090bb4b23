// The edge that joins a light subpath to a camera subpath, without visibility.
#pragma once

#include "path/path_terms.h"
#include "path/subpath.h"

namespace mlt {

/// The terms of a connecting edge at the vertex of one of the subpaths.
struct JointEnd {
  Spectrum value{0};       ///< Throughput times f.
  double onwards = 0;      ///< Density of the edge's direction in projected solid angle.
  double back = 0;         ///< Density of the direction to the previous vertex.
  bool dispersed = false;  ///< Whether the vertex, or one before it, disperses.
};

/// The terms at any vertex; see WalkVertex::Joint for those that are known on arrival.
inline JointEnd any_end(const Scene& scene, const WalkVertex& x, Subpath::From from, const Vec3& w,
                        bool strict) {
  if (from == Subpath::From::light) {
    const VertexTerms terms = joint_terms(scene, x.vertex, x.towards_previous, w, strict);
    return {x.throughput * terms.f, terms.pdf_from_light, terms.pdf_from_camera,
            x.dispersed || terms.disperses};
  }
  const VertexTerms terms = joint_terms(scene, x.vertex, w, x.towards_previous, strict);
  return {x.throughput * terms.f, terms.pdf_from_camera, terms.pdf_from_light,
          x.dispersed || terms.disperses};
}

/// Finds the terms at the vertex for an edge along w; false if it carries no light.
inline bool find_end(const Scene& scene, const WalkVertex& x, Subpath::From from, const Vec3& w,
                     bool strict, JointEnd& end) {
  if (!x.joint.known) {
    end = any_end(scene, x, from, w, strict);
    return !is_black(end.value);
  }
  const SurfacePoint& at = x.vertex.at;
  const auto edge = lambertian_edge(at.ng, at.shading.n, w, x.joint.cosine, strict);
  end.value = from == Subpath::From::light ? x.joint.value : x.joint.value * edge.quotient;
  end.onwards = edge.density();
  end.back = x.joint.back;
  end.dispersed = x.dispersed;
  return edge.scatters;
}

struct JoinedEdge {
  Edge edge;
  JointEnd a, b;      ///< Its ends on the light and on the camera side.
  Spectrum light{0};  ///< f / p.
  Vec2 raster{0};     ///< If b is on the lens.

  /// Finds the edge between the last vertices of the subpaths; false if it carries no light.
  bool find(const Scene& scene, const WalkVertex& from_light, const WalkVertex& from_camera,
            bool strict_normals) {
    find_edge(from_light.vertex.at, from_camera.vertex.at, edge);
    if (!find_end(scene, from_light, Subpath::From::light, edge.w, strict_normals, a)) return false;
    if (from_camera.vertex.kind == VertexKind::camera) {
      const auto [terms, position] = lens_terms(scene, from_camera.vertex.at, -edge.w);
      if (!position) return false;
      raster = *position;
      b = {from_camera.throughput * terms.f, terms.pdf_from_camera, 0};
    } else if (!find_end(scene, from_camera, Subpath::From::camera, -edge.w, strict_normals, b)) {
      return false;
    }
    light = a.value * b.value * edge.G;
    return !is_black(light);
  }
};

}  // namespace mlt
