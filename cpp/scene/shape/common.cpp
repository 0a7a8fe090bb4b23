#include "scene/shape/common.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "scene/mesh.h"
#include "scene/texture.h"

namespace mlt {

Schema shape_schema(const std::string& name, const std::string& doc,
                    std::vector<Parameter> parameters) {
  const Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  parameters.push_back({"to_world", ParamType::transform, identity, "From object to world space."});
  parameters.push_back({"flip_normals", ParamType::boolean, false, "Turn all normals around."});
  parameters.push_back({"bsdf", ParamType::object, {}, "The material; optional."});
  parameters.push_back({"emitter", ParamType::object, {}, "An area light; optional."});
  return {"shape",
          name,
          doc,
          std::move(parameters),
          {"caustic_caster_single", "caustic_caster_multi", "caustic_bouncer"}};
}

Parameter filename_parameter(const std::string& doc) {
  return {"filename", ParamType::text, {}, doc};
}

Parameter face_normals_parameter() {
  return {"face_normals", ParamType::boolean, false,
          "Shade every triangle flat, even if there are vertex normals."};
}

Parameter flip_tex_coords_parameter(bool default_value) {
  return {"flip_tex_coords", ParamType::boolean, default_value,
          "Turn the texture upside down: v becomes 1 - v."};
}

std::string read_file(Params& params) {
  const std::string path = params.text("filename");
  const auto fail = [&](const std::string& why) {
    throw FileError(at(params.where(), "cannot read '" + path + "': " + why));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (!file) fail(std::strerror(errno));
  std::string bytes;
  if (std::fseek(file.get(), 0, SEEK_END) == 0) {
    const long size = std::ftell(file.get());
    // A directory can be opened, too, and claims the largest size there is.
    if (size > 0 && size < std::numeric_limits<long>::max())
      bytes.resize(static_cast<size_t>(size));
    std::rewind(file.get());
  }
  const size_t got = std::fread(&bytes[0], 1, bytes.size(), file.get());
  if (std::ferror(file.get())) fail(std::strerror(errno));
  if (bytes.empty()) fail("it is empty or no regular file");
  if (got != bytes.size()) fail("it ends while it is being read");
  return bytes;
}

void flip_tex_coords(Params& params, MeshData& data) {
  if (!params.boolean("flip_tex_coords")) return;
  for (Vec2f& uv : data.uvs) uv.y = 1 - uv.y;
}

ObjectPtr mesh_from_file(Params& params, MeshData data, bool flat) {
  check_mesh(data, {params.text("filename")});
  flat = params.boolean("face_normals") || flat;
  Mat4 to_world = matrix_param(params, "to_world");
  if (data.normals.empty() && !flat) {
    // In world space: uneven scaling changes the angles that the normals are weighted with.
    transform_mesh(data, to_world, params.where());
    add_smooth_normals(data);
    to_world = Mat4(1);
  }
  return std::make_shared<Mesh>(std::move(data), to_world, flat, params.boolean("flip_normals"),
                                params.where());
}

ObjectPtr flat_mesh(Params& params, MeshData data) {
  const Mat4 to_world = matrix_param(params, "to_world");
  if (glm::determinant(Mat3(to_world)) < 0)
    for (auto& corners : data.triangles) std::swap(corners[1], corners[2]);
  return std::make_shared<Mesh>(std::move(data), to_world, true, params.boolean("flip_normals"),
                                params.where());
}

}  // namespace mlt
