// A triangle mesh from a Wavefront OBJ file; the file's materials are not read.
#include "scene/shape/common.h"
#include "scene/shape/readers.h"

namespace mlt {
namespace {

ObjectPtr create(Params& params) {
  MeshData data = read_obj(read_file(params), params.text("filename"));
  flip_tex_coords(params, data);
  return mesh_from_file(params, std::move(data));
}

}  // namespace

Plugin shape_obj() {
  return {shape_schema("obj", "A mesh from a Wavefront OBJ file.",
                       {filename_parameter("The OBJ file."), face_normals_parameter(),
                        flip_tex_coords_parameter(true)}),
          create};
}

}  // namespace mlt
