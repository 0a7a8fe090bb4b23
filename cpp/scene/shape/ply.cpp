// A triangle mesh from a PLY file (ascii, or binary of either byte order).
#include "scene/shape/common.h"
#include "scene/shape/readers.h"

namespace mlt {
namespace {

ObjectPtr create(Params& params) {
  MeshData data = read_ply(read_file(params), params.text("filename"));
  flip_tex_coords(params, data);
  return mesh_from_file(params, std::move(data));
}

}  // namespace

Plugin shape_ply() {
  return {shape_schema("ply", "A mesh from a PLY (Stanford triangle format) file.",
                       {filename_parameter("The PLY file."), face_normals_parameter(),
                        flip_tex_coords_parameter(false)}),
          create};
}

}  // namespace mlt
