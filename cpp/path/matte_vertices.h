// Matte vertices of many paths from the camera, side by side in single precision: one array for
// each quantity, so that the compiler makes vector instructions of the loops over them.
#pragma once

#include "path/mis.h"
#include "scene/matte.h"
#include "scene/mesh.h"

namespace mlt {

/// consistent_sides of vertex.h, in single precision and without branches.
inline bool consistent_sides(const Vec3f& ng, const Vec3f& n, const Vec3f& w, bool strict) {
  return !strict | (dot(ng, w) * dot(n, w) > 0);
}

struct MatteVertices {
  static constexpr int capacity = 256;

  template <class T>
  struct alignas(32) Array {
    T values[capacity] = {};
    T& operator[](int i) { return values[i]; }
    const T& operator[](int i) const { return values[i]; }
  };
  struct Vectors {
    Array<float> x, y, z;
    Vec3f operator[](int i) const { return {x[i], y[i], z[i]}; }
    void set(int i, const Vec3f& v) {
      x[i] = v.x;
      y[i] = v.y;
      z[i] = v.z;
    }
  };

  int count = 0;

  // The surface, and the direction in which light goes on towards the camera.
  Vectors p, ng, n, wc;
  Array<float> extent;
  Array<float> back;  ///< 1 if the back side scatters light too, else 0.
  Array<Color> f;     ///< The BSDF.
  Array<int> walk;    ///< Whose vertex it is.
  Array<uint32_t> shape;

  // A point on a glowing mesh, chosen by next-event estimation.
  Vectors y, ny;
  Array<float> y_extent;
  Array<float> light_pdf;  ///< Area measure; 0: there is none.
  Array<Color> radiance;   ///< That the point emits.

  // What unshadowed_lights() makes of it: the ray between the two, and |cos| mis / pdf.
  Vectors shadow_o, shadow_w;
  Array<float> shadow_length, light_weight;

  // The numbers for sample_directions(), and what it makes of them: the ray that goes on.
  Array<float> u_x, u_y;
  Array<double> u_roulette;
  Vectors o, w;
  Array<float> scatter_pdf;  ///< Solid angle; 0: there is none.

  void add(int of_walk, uint32_t of_shape, const MeshPoint& point, const Vec3f& towards_camera,
           const Matte& matte);
  void set_light(int i, const MeshPoint& point, const Color& emitted, double pdf);
  void set_no_light(int i) { light_pdf[i] = 0; }
  /// The i-th of them, for what is not computed side by side.
  SurfacePoint point(int i, double time) const;

  void unshadowed_lights(bool strict_normals, Heuristic heuristic);
  void sample_directions(bool strict_normals);
};

}  // namespace mlt
