// Vertices of a block of paths that are computed one by one, in double precision, but for
// scattering by materials that support lanes: those that are neither Lambertian nor glossy on a
// mesh.
#pragma once

#include "path/path_tracer.h"

#include <optional>
#include <vector>

namespace mlt {

struct SingleVertex {
  int path;
  SurfacePoint at;
  Vec3 wc;               ///< Towards the camera.
  EmitterChoice choice;  ///< The light that it samples; probability 0: there is none.
  Vec2 u_light;          ///< The numbers for the position on it.
  LightSample light;     ///< The sampled position.
  Vec3 u_scatter;        ///< The numbers for the scattered direction.

  const Bsdf* bsdf;  ///< Its material if that supports lanes, else nullptr.
  /// Whether the results below were computed together with other vertices.
  bool in_lanes;
  WorldScattering from_light;  ///< Between the light and the camera.
  std::optional<ScatterSample> scattered;

  bool samples_light() const { return choice.probability > 0; }
  /// See unshadowed_light(); wl points to the light.
  WorldScattering scattering(const Scene& scene, const Vec3& wl) const {
    return in_lanes ? from_light : BsdfAt(scene, at).scattering(wl, wc, Lobe::smooth);
  }
};

class SingleVertices {
 public:
  void clear() { count_ = 0; }
  SingleVertex& operator[](int i) { return vertices_[i]; }
  SingleVertex* begin() { return vertices_.data(); }
  SingleVertex* end() { return begin() + count_; }

  /// Adds a vertex, whose place is still to be set, and returns its index. References to others
  /// become invalid.
  int add(int path, const Vec3& wc) {
    if (count_ == static_cast<int>(vertices_.size())) vertices_.emplace_back();
    SingleVertex& vertex = vertices_[count_];
    vertex.path = path;
    vertex.wc = wc;
    vertex.choice.probability = 0;
    vertex.in_lanes = false;
    return count_++;
  }
  void drop_last() { --count_; }

  /// Computes the scattering of all vertices whose materials support lanes.
  void scatter_in_lanes(const Scene& scene, bool strict_normals);

 private:
  std::vector<SingleVertex> vertices_;
  int count_ = 0;  ///< Number of vertices in use.
  ScatteringLanes lanes_;
};

}  // namespace mlt
