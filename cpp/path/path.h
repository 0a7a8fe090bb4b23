// A light path as a value: x_0 on a light ... x_k on the camera's lens, always in that direction,
// by whichever technique it was made.
#pragma once

#include "base/bytes.h"
#include "path/vertex.h"

#include <vector>

namespace mlt {

struct Path {
  std::vector<Vertex> vertices;
  double time = 0;
  double wavelength = rgb_lanes;  ///< See wavelengths.h.

  /// Sets the time of all vertices; their positions stay the same.
  void set_time(double moment) {
    time = moment;
    for (Vertex& x : vertices) x.at.time = moment;
  }
  /// Sets the wavelength of all vertices.
  void set_wavelength(double u) {
    wavelength = u;
    for (Vertex& x : vertices) x.at.wavelength = u;
  }

  int edges() const { return static_cast<int>(vertices.size()) - 1; }  ///< k
  Vertex& operator[](size_t i) { return vertices[i]; }
  const Vertex& operator[](size_t i) const { return vertices[i]; }
};

/// A path as bytes, member by member: equal paths are equal bytes.
void save(ByteWriter& bytes, const Path& path);
void load(ByteReader& bytes, Path& path);

/// The raster position of the path; nullopt if it misses the image.
std::optional<Vec2> raster_position(const Scene& scene, const Path& path);

/// Whether a vertex scatters (almost) in one direction: by a delta, or with a roughness below the
/// threshold. A function of the BSDF, the position and the two directions alone.
inline bool is_specular(const Scene& scene, const Vertex& x, const Vec3& wl, const Vec3& wc,
                        double near_specular) {
  if (x.delta()) return true;
  return x.kind == VertexKind::inner && BsdfAt(scene, x.at).smoother_than(near_specular, wl, wc);
}

}  // namespace mlt
