// A triangle mesh: float buffers, as Embree wants them, in world space.
#pragma once

#include "math/distribution.h"
#include "scene/shape.h"

#include <array>
#include <vector>

namespace mlt {

/// The buffers of a mesh; normals and uvs are empty or as many as the positions.
struct MeshData {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;
  std::vector<Vec2f> uvs;
  std::vector<std::array<uint32_t, 3>> triangles;
};

class Mesh : public Shape {
 public:
  /// Takes buffers in object space and moves them to world space.
  /// `face_normals`: drop the vertex normals. `flip_normals`: turn all normals around.
  /// Throws SceneError (empty mesh, index out of range, non-finite vertex, singular transform).
  Mesh(MeshData data, const Mat4& to_world, bool face_normals, bool flip_normals,
       const Location& where);

  const MeshData& data() const { return data_; }
  size_t bytes() const;

  void surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const override;
  double area() const override { return area_; }
  PositionSample sample_position(const Vec2& u) const override;
  Vec2 invert_position(const SurfacePoint& at) const override;
  void bounds(Vec3& low, Vec3& high) const override;
  const Mesh* as_mesh() const override { return this; }

 private:
  void fill(uint32_t triangle, double b1, double b2, SurfacePoint& at) const;

  MeshData data_;
  bool flip_normals_ = false;
  double area_ = 0;
  Discrete triangle_areas_;  ///< Built only for meshes that emit (see prepare_sampling).

 public:
  /// Builds the table that sample_position needs; called for meshes that carry an emitter.
  void prepare_sampling();
};

}  // namespace mlt
