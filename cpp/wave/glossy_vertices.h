// Vertices of a block of paths on meshes whose materials support lanes, in single precision. Their
// places and sides are those of the same lanes of LambertianVertices.
#pragma once

#include "wave/lambertian_vertices.h"

#include <array>

namespace mlt {

struct GlossyVertex {
  int path;
  const Bsdf* bsdf;
  SurfacePoint at;       ///< What textures use of it.
  FrameOf<float> frame;  ///< At first, s is a multiple of dp/du.
  Vec3f wc;              ///< Towards the camera, in that frame.
  Vec3 u_scatter;        ///< The numbers for the scattered direction.

  // A sampled light that is not behind the surface:
  float light_pdf;  ///< Per solid angle; 0: there is none.
  Vec3f wl;         ///< Its direction in the frame.
  Spectrum radiance;
  bool delta;

  // The results of scatter(), with densities per solid angle; 0: nothing is scattered.
  bool in_lanes;
  Spectrum f_light, f_cos;  ///< The latter times |cos| of the scattered direction.
  float pdf_light, pdf;
  Vec3f to;  ///< The scattered direction, in world space.

  void set_light(const Vec3f& w, float pdf, const Spectrum& its_radiance, bool is_delta) {
    wl = frame.to_local(w);
    light_pdf = pdf;
    radiance = its_radiance;
    delta = is_delta;
  }
};

class GlossyVertices {
 public:
  void clear() { count_ = 0; }
  GlossyVertex& operator[](int i) { return vertices_[size_t(i)]; }
  GlossyVertex* begin() { return vertices_.data(); }
  GlossyVertex* end() { return begin() + count_; }

  /// Adds a vertex at these barycentrics of a triangle, and returns its index.
  int add(int path, const LaneMesh& shape, uint32_t triangle, const Vec2f& b, double time,
          double wavelength);
  /// Finds the frames, by the normals of `points`; d are the directions of the incident rays.
  void find_frames(const LambertianVertices& points, const float* d_x, const float* d_y,
                   const float* d_z);
  /// Computes the scattering of all vertices.
  void scatter();

 private:
  std::array<GlossyVertex, block_size> vertices_;
  int count_ = 0;
  ScatteringLanes lanes_;
};

}  // namespace mlt
