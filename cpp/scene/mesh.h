// A triangle mesh: float buffers, as Embree wants them, in world space.
#pragma once

#include "math/distribution.h"
#include "scene/mesh_data.h"
#include "scene/shape.h"

namespace mlt {

class Mesh : public Shape {
 public:
  /// Takes buffers in object space and moves them to world space.
  /// `face_normals`: drop the vertex normals. `flip_normals`: turn all normals around.
  /// Throws SceneError (empty mesh, index out of range, non-finite vertex, singular transform).
  Mesh(MeshData data, const Mat4& to_world, bool face_normals, bool flip_normals,
       const Location& where);

  Mesh(const Mesh&) = delete;

  /// There is room for 16 bytes at every position, also the last: the accelerator reads so many.
  const MeshData& data() const { return data_; }
  size_t bytes() const;

  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  double area() const override { return area_; }
  PositionSample sample_position(const Vec2& u) const override;
  Vec2 invert_position(const SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override;
  const Mesh* as_mesh() const override { return this; }

  /// Builds the table that sample_position needs; called for meshes that carry an emitter.
  /// Throws SceneError if the mesh has no area.
  void prepare_sampling();

 private:
  using Triangle = MeshData::Triangle;
  Triangle triangle(uint32_t index) const;
  float reach(uint32_t vertex) const;
  void fill(const Triangle& triangle, uint32_t index, double b1, double b2, SurfacePoint& at) const;

  MeshData data_;
  double side_;  ///< -1 with flip_normals, else 1.
  double area_ = 0;
  Discrete triangle_areas_;  ///< Built only for meshes that emit (see prepare_sampling).
};

}  // namespace mlt
