// Readers of mesh files. They work from memory, check all sizes and indices in the file, and throw
// SceneError with the file's name (and line, where it has lines) for anything malformed. The memory
// that they allocate is bounded by the size of the file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "scene/mesh/mesh_data.h"

namespace mlt {

/// Wavefront OBJ. All groups and objects make one mesh; vertices are shared between faces that name
/// the same position, texture coordinate and normal. Polygons, concave ones too, become triangles.
/// Normals and texture coordinates that are no numbers are not given. With a `material`, the faces
/// are those after `usemtl` with this name ("": those before the first one).
MeshData read_obj(std::string_view bytes, const std::string& name,
                  const std::optional<std::string>& material = {});

/// PLY, ascii or binary of either byte order. Polygons, concave ones too, become triangles.
MeshData read_ply(std::string_view bytes, const std::string& name);

struct SerializedMesh {
  MeshData mesh;
  bool face_normals;  ///< Whether the file asks for flat shading.
};

/// Mesh number `index` of a Mitsuba .serialized file, version 3 or 4.
SerializedMesh read_serialized(std::string_view bytes, int64_t index, const std::string& name);

}  // namespace mlt
