// Lambertian vertices of many paths from the camera, side by side in single precision. Lanes of
// paths without a Lambertian vertex are computed too, and ignored.
#pragma once

#include "math/lanes.h"
#include "path/mis.h"
#include "path/walk.h"
#include "scene/bsdf/lambertian.h"
#include "scene/mesh/mesh.h"
#include "scene/scene.h"

#include <array>

namespace mlt {

/// Points on triangles.
struct TriangleBlock {
  VectorBlock p0, p1, p2, ng;
  Block<float> b1, b2, extent;

  void set(int i, const TriangleRecord& record, float b_1, float b_2) {
    p0.set(i, record.p0);
    p1.set(i, record.p1);
    p2.set(i, record.p2);
    ng.set(i, Vec3f(record.ng));
    b1[i] = b_1;
    b2[i] = b_2;
    extent[i] = record.extent;
  }
  /// A point alone.
  void set(int i, const Vec3f& p, const Vec3f& normal, float extent_of_it) {
    p0.set(i, p);
    p1.set(i, p);
    p2.set(i, p);
    ng.set(i, normal);
    b1[i] = b2[i] = 0;
    extent[i] = extent_of_it;
  }
  Vec3f position(int i) const {
    return p0[i] * (1 - b1[i] - b2[i]) + p1[i] * b1[i] + p2[i] * b2[i];
  }
};

struct LambertianVertices {
  TriangleBlock surface;
  VectorBlock p, n;          ///< find_points() normalises n.
  Block<float> back;         ///< 1 if the back side scatters light too, else 0.
  Block<float> sides;        ///< 0 if strict normals reject the incident ray, else 1.
  Block<const Spectrum*> f;  ///< BSDF; nullptr: there is no Lambertian vertex.

  // A point on an emissive mesh, sampled by next-event estimation:
  TriangleBlock light;
  Block<float> light_pdf;           ///< Per area; 0: there is no point.
  Block<const Spectrum*> radiance;  ///< Emitted by the point.

  // The results of unshadowed_lights(): the direction to the point, its density in solid angle, the
  // shadow ray, and |cos| mis / pdf.
  VectorBlock wl, shadow_o, shadow_w;
  Block<float> direction_pdf, shadow_length, light_weight;

  // For sample_directions(): two random numbers for each path, and the scattered ray.
  Block<double> u_x, u_y;
  VectorBlock o, w;
  Block<float> scatter_pdf;  ///< Per solid angle; 0: there is no ray.

  /// Sets the place of the i-th path to these barycentrics of a triangle.
  void set_place(int i, const Mesh& mesh, uint32_t triangle, float b1, float b2, bool both_sides) {
    const TriangleRecord& record = mesh.record(triangle);
    surface.set(i, record, b1, b2);
    n.set(i, mesh.has_normals() ? mesh.normal_sum(triangle, {b1, b2}) : Vec3f(record.ng));
    back[i] = both_sides ? 1 : 0;
  }
  /// Sets the vertex of the i-th path to these barycentrics of a triangle.
  void set(int i, const LaneMesh& shape, uint32_t triangle, float b1, float b2, double time,
           double wavelength) {
    const Mesh& mesh = *shape.mesh;
    set_place(i, mesh, triangle, b1, b2,
              shape.lambertian->lambertian.sides == Lambertian::Sides::both);
    if (shape.lambertian->uniform() && wavelength < 0) {
      f[i] = &shape.lambertian->lambertian.f;
      return;
    }
    f[i] = &textured_f_[i];
    TexturedPoint& point = textured_[textured_count_++];
    point.path = i;
    point.lambertian = shape.lambertian;
    point.at.time = time;
    point.at.wavelength = wavelength;
    if (shape.lambertian->uniform()) return;
    mesh.textured_point(triangle, {b1, b2}, point.at);
    point.lambertian->reflectance->prefetch(point.at);
  }
  /// Sets the vertex of the i-th path to a point that is known to be Lambertian.
  void set(int i, const SurfacePoint& at) {
    set_position(i, at);
    back[i] = at.lambertian.sides == Lambertian::Sides::both ? 1 : 0;
    textured_f_[i] = at.lambertian.f;
    f[i] = &textured_f_[i];
  }
  /// Sets the position of the i-th path to that of a vertex which is not Lambertian.
  void set_position(int i, const SurfacePoint& at) {
    surface.set(i, Vec3f(at.p), Vec3f(at.ng), static_cast<float>(at.extent));
    n.set(i, Vec3f(at.shading.n));
    back[i] = 1;
  }
  /// Looks up the reflectances that depend on the point or on the wavelength, of all vertices.
  void find_reflectances() {
    for (int j = 0; j < textured_count_; ++j) {
      const TexturedPoint& point = textured_[j];
      textured_f_[point.path] = point.lambertian->at(point.at).f;
    }
    textured_count_ = 0;
  }
  /// Sets the light point of the i-th path to this one, if the light was chosen with this
  /// probability.
  [[gnu::always_inline]] void set_light(int i, const MeshLight& chosen, double probability,
                                        const Mesh::Barycentrics& point, double wavelength) {
    const Mesh& mesh = *chosen.mesh;
    const auto& [triangle, b, per_pdf] = point;
    light.set(i, mesh.record(triangle), static_cast<float>(b.x), static_cast<float>(b.y));
    if (mesh.has_normals()) {
      const Vec3f ng = light.ng[i];
      light.ng.set(i, ng * std::copysign(1.0f, dot(ng, mesh.normal_sum(triangle, Vec2f(b)))));
    }
    light_pdf[i] = static_cast<float>(probability / per_pdf);
    if (wavelength < 0) {
      radiance[i] = &chosen.rgb;
    } else {
      spectral_radiance_[i] = chosen.radiance_at(wavelength);
      radiance[i] = &spectral_radiance_[i];
    }
  }
  /// Sets the light point of the i-th path to one of a lamp that is no mesh and not at infinity.
  void set_lamp(int i, const LightSample& lamp, const Scene& scene) {
    const SurfacePoint& y = lamp.x0.at;
    const Vec3 w = normalize(y.p - Vec3(p[i]));
    const Spectrum emitted = lamp.x0.pdf > 0 ? lamp.emitted(-w) : Spectrum(0);
    // A larger density with as much more light has a larger MIS weight: that beside scattered rays
    // which stop at the lamp with this probability, or never.
    const double stops = lamp.emitter->delta() ? 0 : scene.stop_probability(y, w);
    const double large = std::min(1 / stops, 0x1p64);
    const Vec3 ng = y.kind == PointKind::surface ? y.ng : -w;
    light.set(i, Vec3f(y.p), Vec3f(ng), static_cast<float>(y.extent));
    light_pdf[i] = is_black(emitted) ? 0 : static_cast<float>(large * lamp.x0.pdf);
    spectral_radiance_[i] = large * emitted;
    radiance[i] = &spectral_radiance_[i];
  }

  // Each function works on the first `count` paths; d are the directions of their incident rays.
  void find_points(int count, const float* d_x, const float* d_y, const float* d_z,
                   bool strict_normals);
  void unshadowed_lights(int count, bool strict_normals, const MisExponent& mis);
  void sample_directions(int count, bool strict_normals);

  /// The unshadowed light of the i-th vertex from a light at infinity in the direction w, as a
  /// factor of its radiance and of f: |cos| mis / pdf. `pdf` is that of w in solid angle.
  float weight_from_infinity(int i, const Vec3f& w, float pdf, bool delta, bool strict_normals,
                             const MisExponent& mis) const {
    if (!(pdf > 0 && is_lit_from(i, w, strict_normals))) return 0;
    return delta ? cosine(i, w) / pdf : direct_weight(cosine(i, w), pdf, mis);
  }
  /// The mis in the light_weight of the i-th vertex.
  double light_mis(int i) const { return light_weight[i] * direction_pdf[i] / cosine(i, wl[i]); }
  /// Whether light from the direction wl is scattered to the camera.
  bool is_lit_from(int i, const Vec3f& wl, bool strict_normals) const {
    const float cos_l = dot(wl, n[i]), cos_c = dot(wc_[i], n[i]);
    const bool scattered = scatters(cos_c, back[i] > 0),
               consistent = consistent_sides(surface.ng[i], n[i], wl, strict_normals);
    return (cos_l * cos_c > 0) & scattered & (sides[i] > 0) & consistent;
  }
  /// Sets the shadow ray of the i-th vertex to one in this direction.
  void aim_at_infinity(int i, const Vec3f& direction) {
    shadow_o.set(i, ray_origin(p[i], surface.ng[i], direction, surface.extent[i]));
    shadow_w.set(i, direction);
    shadow_length[i] = std::numeric_limits<float>::infinity();
  }
  /// Sets the scattered ray of the i-th vertex; false: strict normals reject it.
  bool leave_in(int i, const Vec3f& direction, bool strict_normals) {
    o.set(i, ray_origin(p[i], surface.ng[i], direction, surface.extent[i]));
    w.set(i, direction);
    const bool consistent = consistent_sides(surface.ng[i], n[i], direction, strict_normals);
    return (sides[i] > 0) & consistent;
  }
  /// |cos| of a direction from the i-th vertex.
  float cosine(int i, const Vec3f& w) const { return std::fabs(dot(w, n[i])); }

 private:
  /// |cos| mis / pdf of next-event estimation with this density in solid angle; scattered
  /// directions have |cos| / pi.
  static float direct_weight(float cosine, float pdf, const MisExponent& mis) {
    return cosine / (pdf * (1 + mis.raise(lambertian_pdf(cosine) / pdf)));
  }

  VectorBlock wc_;  ///< Direction towards the camera.

  /// A point whose reflectance is still to be looked up.
  struct TexturedPoint {
    int path;
    const LambertianSurface* lambertian;
    SurfacePoint at;
  };
  int textured_count_ = 0;
  std::array<TexturedPoint, block_size> textured_;
  Block<Spectrum> textured_f_, spectral_radiance_;
};

}  // namespace mlt
