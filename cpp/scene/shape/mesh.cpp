// A mesh whose buffers are in the scene, as bytes in the machine's order: from the arrays of a
// Python dict.
#include "scene/shape/common.h"

#include <cstring>

namespace mlt {
namespace {

/// The bytes of a parameter as elements of type T; none if it is not given.
template <class T>
std::vector<T> buffer(Params& params, const char* name) {
  if (!params.has(name)) return {};
  const Buffer held = params.buffer(name);
  const std::string& bytes = held.bytes();
  if (bytes.size() % sizeof(T) != 0)
    params.fail(name, fmt::format("has {} bytes, which is no multiple of {}; give it as an array "
                                  "from Python",
                                  bytes.size(), sizeof(T)));
  std::vector<T> elements(bytes.size() / sizeof(T));
  std::memcpy(elements.data(), bytes.data(), bytes.size());
  return elements;
}

ObjectPtr create_mesh(Params& params) {
  MeshData data;
  data.positions = buffer<Vec3f>(params, "vertices");
  data.triangles = buffer<std::array<uint32_t, 3>>(params, "faces");
  data.normals = buffer<Vec3f>(params, "normals");
  data.uvs = buffer<Vec2f>(params, "uv");
  if (params.has("vertex_color"))
    data.attributes.push_back({"vertex_color", false, 3, buffer<float>(params, "vertex_color")});
  check_mesh(data, params.where());
  return mesh_from_data(params, std::move(data));
}

}  // namespace

Plugin shape_mesh() {
  return {
      shape_schema(
          "mesh", "A triangle mesh from arrays in memory, which a Python dict can give.",
          concat({{{"vertices", ParamType::buffer, no_default, "Positions: float32, (n, 3)."},
                   {"faces", ParamType::buffer, no_default, "Corners: uint32, (m, 3)."},
                   {"normals", ParamType::buffer, no_default, "Of the vertices: float32, (n, 3)."},
                   {"uv", ParamType::buffer, no_default, "Texture coordinates: float32, (n, 2)."},
                   {"vertex_color", ParamType::buffer, no_default,
                    "Linear colours for the texture mesh_attribute: float32, (n, 3)."}},
                  normals_parameters()})),
      create_mesh};
}

}  // namespace mlt
