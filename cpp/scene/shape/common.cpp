#include "scene/shape/common.h"

#include "base/atomic_file.h"
#include "base/gzip.h"
#include "scene/mesh/mesh.h"
#include "scene/texture/texture.h"
#include "scene/transform/transform_params.h"

#include <cstring>

namespace mlt {

Schema shape_schema(const std::string& name, const std::string& doc,
                    std::vector<Parameter> parameters) {
  const Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  parameters.push_back({"to_world", ParamType::motion, identity, "From object to world space."});
  parameters.push_back({"flip_normals", ParamType::boolean, false, "Turn all normals around."});
  parameters.push_back({"priority", ParamType::integer, no_default,
                        "Where solids overlap, that of the highest priority is there; optional."});
  parameters.push_back({"bsdf", ParamType::object, no_default, "The material; optional."});
  parameters.push_back({"emitter", ParamType::object, no_default, "An area light; optional."});
  return {"shape",
          name,
          doc,
          std::move(parameters),
          {"caustic_caster_single", "caustic_caster_multi", "caustic_bouncer"}};
}

Parameter filename_parameter(const char* doc) {
  return {"filename", ParamType::text, no_default, doc};
}

std::vector<Parameter> normals_parameters() {
  return {{"face_normals", ParamType::boolean, false,
           "Shade every triangle flat, even if there are vertex normals."},
          {"max_smooth_angle", ParamType::real, no_default,
           "Make normals anew, smooth except where neighbours differ by more than these degrees."}};
}

namespace {

std::string name_of_mesh(Params& params) {
  return params.has("data") ? "'data'" : params.text("filename");
}

/// Throws SceneError for a file of another program, by its extension.
void refuse_foreign_mesh(const Params& params, const std::string& path) {
  for (const char* kind :
       {".3ds", ".3mf", ".abc", ".blend", ".c4d", ".dae", ".fbx", ".glb",  ".gltf", ".iges",
        ".igs", ".max", ".off", ".step",  ".stl", ".stp", ".usd", ".usda", ".usdc", ".usdz"}) {
    const size_t length = std::strlen(kind);
    if (path.size() > length && path.compare(path.size() - length, length, kind) == 0)
      params.fail("filename", fmt::format("names a {} file, which is not read as a mesh; export it "
                                          "as OBJ or PLY",
                                          kind));
  }
}

}  // namespace

Plugin mesh_file_plugin(const char* name, const char* doc, const char* filename_doc,
                        bool flip_tex_coords, MeshReader read, const std::vector<Parameter>& own) {
  return {shape_schema(name, doc,
                       concat({{filename_parameter(filename_doc),
                                {"data", ParamType::buffer, no_default,
                                 "In place of `filename`: the bytes of such a file."}},
                               normals_parameters(),
                               {{"flip_tex_coords", ParamType::boolean, flip_tex_coords,
                                 "Turn the texture upside down: v becomes 1 - v."}},
                               own})),
          [read](Params& params) {
            const std::string path = name_of_mesh(params);
            refuse_foreign_mesh(params, path);
            const auto unpack = [&](std::string_view bytes) {
              return is_gzip(bytes) ? read(unpack_gzip(bytes, path), path, params)
                                    : read(bytes, path, params);
            };
            MeshData data = params.has("data") ? unpack(params.buffer("data").bytes())
                                               : unpack(read_file(path));
            for (const std::string& warning : data.warnings) params.warn(path + ": " + warning);
            if (params.boolean("flip_tex_coords"))
              for (Vec2f& uv : data.uvs) uv.y = 1 - uv.y;
            return mesh_from_file(params, std::move(data));
          }};
}

ObjectPtr mesh_from_file(Params& params, MeshData data, bool flat) {
  check_mesh(data, {name_of_mesh(params)});
  return mesh_from_data(params, std::move(data), flat);
}

ObjectPtr mesh_from_data(Params& params, MeshData data, bool flat) {
  const bool creased = params.has("max_smooth_angle");
  if (creased && params.boolean("face_normals"))
    params.fail("max_smooth_angle", "and 'face_normals' exclude each other");
  flat = (params.boolean("face_normals") || flat) && !creased;
  Mat4 to_world = matrix_param(params, "to_world");
  if (creased || (data.normals.empty() && !flat)) {
    // In world space: uneven scaling changes the angles that the normals are weighted with.
    transform_mesh(data, to_world, params.where());
    if (creased)
      add_creased_normals(data, params.real_in("max_smooth_angle", 0, 180));
    else
      add_smooth_normals(data);
    to_world = Mat4(1);
  }
  return std::make_shared<Mesh>(std::move(data), to_world, flat, params.boolean("flip_normals"),
                                params.where());
}

Plugin flat_shape_plugin(const char* name, const char* doc, MeshData (*make)()) {
  return {shape_schema(name, doc,
                       {{"face_normals", ParamType::boolean, false,
                         "Accepted for files that set it; the shape is flat anyway."}}),
          [make](Params& params) {
            params.boolean("face_normals");
            MeshData data = make();
            const Mat4 to_world = matrix_param(params, "to_world");
            if (glm::determinant(Mat3(to_world)) < 0)
              for (auto& corners : data.triangles) std::swap(corners[1], corners[2]);
            return std::make_shared<Mesh>(std::move(data), to_world, true,
                                          params.boolean("flip_normals"), params.where());
          }};
}

}  // namespace mlt
