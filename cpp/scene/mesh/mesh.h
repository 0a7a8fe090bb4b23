// A triangle mesh: float buffers in the format of Embree, in world space.
#pragma once

#include "base/shared_array.h"
#include "math/distribution.h"
#include "math/warp.h"
#include "scene/light/light_tree.h"
#include "scene/mesh/mesh_data.h"
#include "scene/shape/shape.h"

#include <memory>
#include <optional>

namespace mlt {

/// The data of a triangle that every hit needs, in one cache line, without normals and uvs.
struct alignas(64) TriangleRecord {
  Vec3f p0, p1, p2;
  float extent;  ///< Largest coordinate, without its sign.
  Vec3 ng;  ///< Unit; (0, 0, 1) of a triangle without area. The mesh's `flip_normals` is in it.

  /// The edges, and p0, in double precision.
  struct Edges {
    Vec3 p0, e1, e2;
  };
  Edges edges() const {
    const Vec3 p(p0);
    return {p, Vec3(p1) - p, Vec3(p2) - p};
  }
};

/// Solves e1 = d1.x dp/du + d1.y dp/dv and e2 likewise for dp/du, up to a positive factor.
template <class F>
Vec3Of<F> multiple_of_dp_du(const Vec3Of<F>& e1, const Vec3Of<F>& e2, const Vec2Of<F>& d1,
                            const Vec2Of<F>& d2) {
  return (e1 * d2.y - e2 * d1.y) * std::copysign(F(1), d1.x * d2.y - d1.y * d2.x);
}

class Mesh : public Shape {
 public:
  /// Takes buffers in object space and moves them to world space.
  /// `face_normals`: drop the vertex normals. `flip_normals`: turn all normals around.
  /// Throws SceneError (empty mesh, index out of range, non-finite vertex, singular transform).
  Mesh(MeshData data, const Mat4& to_world, bool face_normals, bool flip_normals,
       const Location& where);

  ObjectPtr copy() const override { return std::make_shared<Mesh>(*this); }

  /// The buffers; there are 16 bytes at every position, also the last: the accelerator reads them.
  const MeshData& data() const { return *data_; }
  size_t bytes() const;

  /// The shading normal in a space to which normals are moved by the transpose of `inverse`, as if
  /// the vertices' were moved and then interpolated; nullopt if it is the geometric normal.
  std::optional<Vec3> moved_normal(const SurfacePoint& at, const Mat3& inverse) const;

  const TriangleRecord& record(uint32_t triangle) const { return records_[triangle]; }
  bool has_normals() const { return normals_ != nullptr; }
  /// In single precision, a multiple of the shading normal; the geometric normal where there is
  /// none.
  Vec3f normal_sum(uint32_t triangle, const Vec2f& b) const {
    const Vec3f ng(records_[triangle].ng);
    if (!normals_) return ng;
    const auto& corners = triangles_[triangle];
    const Vec3f sum = normals_[corners[0]] * (1 - b.x - b.y) + normals_[corners[1]] * b.x +
                      normals_[corners[2]] * b.y;
    return dot(sum, sum) > 1e-12f ? sum * static_cast<float>(side_) : ng;
  }
  /// In single precision, a positive multiple of dp/du; 0 without uvs.
  Vec3f along_u(uint32_t triangle) const {
    if (!uvs_) return Vec3f(0);
    const TriangleRecord& record = records_[triangle];
    const auto& corners = triangles_[triangle];
    const Vec2f uv0 = uvs_[corners[0]];
    return multiple_of_dp_du(record.p1 - record.p0, record.p2 - record.p0, uvs_[corners[1]] - uv0,
                             uvs_[corners[2]] - uv0);
  }
  /// Sets the members of a point that textures use: position, uv, shape and primitive.
  void textured_point(uint32_t triangle, const Vec2& b, SurfacePoint& at) const;

  struct Barycentrics {
    uint32_t triangle;
    Vec2 b;
    double per_pdf;  ///< 1 / density per area.
  };
  /// The triangle and barycentrics that sample_position() and sample_direct() sample.
  Barycentrics sample_barycentrics(const Vec2& u) const {
    const Discrete::Sample chosen = triangle_areas_.sample_reuse(u.x);
    return {static_cast<uint32_t>(chosen.index), sample_triangle({chosen.remainder, u.y}), area_};
  }
  Barycentrics sample_barycentrics_for(const Vec3& from, const Vec2& u) const;
  /// Whether the latter depends on `from`.
  bool chooses_by_point() const { return !triangle_tree_.empty(); }
  /// The density per area with which sample_direct() samples the points of a triangle.
  double direct_density(uint32_t triangle, const Vec3& from) const;
  /// The normal of a triangle on the side where its light is; nullopt if that may be either side.
  std::optional<Vec3> bright_side(uint32_t triangle) const;
  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  bool has_tangent() const override { return uvs_ && !(bsdf_ && bsdf_->lambertian().known()); }
  double area() const override { return area_; }
  PositionSample sample_position(const Vec2& u) const override {
    return position(sample_barycentrics(u));
  }
  Vec2 invert_position(const SurfacePoint& at) const override;
  PositionSample sample_direct(const Vec3& from, const Vec2& u) const override;
  double pdf_direct(const Vec3& from, const SurfacePoint& at) const override {
    return direct_density(at.primitive, from);
  }
  Vec2 invert_direct(const Vec3& from, const SurfacePoint& at) const override;
  UvTangents uv_tangents(const SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override {
    low = low_;
    high = high_;
  }
  const Mesh* as_mesh() const override { return this; }

  /// Barycentrics of the corners after the first one, at a point of this mesh.
  Vec2 barycentrics(const SurfacePoint& at) const;

  /// Builds the tables that these need, once; called for meshes that carry an emitter.
  /// Throws SceneError if the mesh has no area.
  void prepare_sampling();

 private:
  using Edges = TriangleRecord::Edges;
  /// Whether the vertices have normals that are not those of the triangles.
  bool has_smooth_normals() const;
  PositionSample position(const Barycentrics& point) const;
  double area_of(uint32_t triangle) const { return triangle_areas_.pdf(triangle) * area_; }
  LightBounds bounds_of(uint32_t triangle) const;
  Vec2 invert_in_triangle(const SurfacePoint& at) const;
  void fill(const Edges& edges, uint32_t index, double b1, double b2, SurfacePoint& at) const;

  std::shared_ptr<const MeshData> data_;
  // The buffers of data_; nullptr if there are no smooth normals or uvs.
  const std::array<uint32_t, 3>* triangles_;
  const Vec3f* normals_;
  const Vec2f* uvs_;
  SharedArray<TriangleRecord> records_;  ///< One for each triangle.
  double side_;                          ///< -1 with flip_normals, else 1.
  double area_ = 0;
  Vec3 low_, high_;
  // Built only for meshes that emit (see prepare_sampling):
  Discrete triangle_areas_;
  LightTree triangle_tree_;  ///< Empty if the triangles are few.
};

}  // namespace mlt
