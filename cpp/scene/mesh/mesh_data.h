// The buffers of a triangle mesh, and the operations on them between a file and a Mesh.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/error.h"
#include "math/vec.h"

namespace mlt {

/// Numbers at the vertices of a mesh or on its triangles, such as colours.
struct MeshAttribute {
  std::string name;  ///< Begins with "vertex_" or "face_".
  bool on_faces = false;
  uint32_t channels = 0;
  std::vector<float> values;  ///< `channels` for each vertex or triangle.
};

/// The buffers of a mesh; normals and uvs are empty or as many as the positions.
struct MeshData {
  std::vector<Vec3f> positions;  ///< From `origin`.
  std::vector<Vec3f> normals;
  std::vector<Vec2f> uvs;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<MeshAttribute> attributes = {};
  /// Far away, as survey coordinates are, single precision is too coarse for a mesh; from a point
  /// nearby it is not.
  Vec3 origin{0};

  /// What the file has and the mesh has not.
  std::vector<std::string> warnings = {};

  /// The origin for positions of which this is the first: it if it is far away, else 0.
  static Vec3 origin_for(const Vec3& first) {
    return max_component(glm::abs(first)) < 1024 ? Vec3(0) : first;
  }

  /// The attribute of this name, or nullptr.
  const MeshAttribute* find_attribute(const std::string& name) const {
    for (const MeshAttribute& attribute : attributes)
      if (attribute.name == name) return &attribute;
    return nullptr;
  }

  /// A triangle in double precision: a corner, the edges to the two others, and their cross
  /// product, whose length is twice the area.
  struct Triangle {
    Vec3 p0, e1, e2, normal;
  };
  Triangle triangle(const std::array<uint32_t, 3>& corners) const {
    const Vec3 p0(positions[corners[0]]);
    const Vec3 e1 = Vec3(positions[corners[1]]) - p0, e2 = Vec3(positions[corners[2]]) - p0;
    return {p0, e1, e2, cross(e1, e2)};
  }
};

/// Throws SceneError at `where` if the mesh is empty, an index is out of range, a position or uv is
/// not finite, or a buffer has the wrong length.
void check_mesh(const MeshData& data, const Location& where);

/// Applies a transform to positions and normals; the origin becomes 0. Throws SceneError at `where`
/// if the transform is singular.
void transform_mesh(MeshData& data, const Mat4& to_world, const Location& where);

/// Sets every vertex normal to the mean of the normals of its triangles, weighted by their angles
/// (Thuermer & Wuethrich 1998, "Computing vertex normals from polygonal facets").
void add_smooth_normals(MeshData& data);

/// Makes the mesh smooth except where the normals of neighbours differ by more than `angle`
/// degrees: the triangles at a vertex are divided into groups, of those that differ by less from
/// the first one, and every group gets a vertex of its own (the rule of Mitsuba 0.6). Vertices at
/// the same position with the same texture coordinates count as one.
void add_creased_normals(MeshData& data, double angle);

/// Replaces normals that are zero or not finite by the normal of a triangle they belong to, and
/// makes the others unit vectors.
void repair_normals(MeshData& data);

/// Whether a transform maps some direction to nothing (up to rounding).
bool is_singular(const Mat4& m);

}  // namespace mlt
