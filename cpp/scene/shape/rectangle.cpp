// The square [-1, 1] x [-1, 1] in the plane z = 0, with the normal +z; uv runs from 0 to 1 along x
// and y.
#include "scene/shape/common.h"

namespace mlt {
namespace {

ObjectPtr create(Params& params) {
  params.boolean("face_normals");
  MeshData data;
  data.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  data.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  data.triangles = {{0, 1, 2}, {0, 2, 3}};
  return flat_mesh(params, std::move(data));
}

}  // namespace

Plugin shape_rectangle() {
  return {shape_schema("rectangle", "A square of side 2 in the xy plane that faces +z.",
                       {{"face_normals", ParamType::boolean, false,
                         "Accepted for files that set it; it is flat anyway."}}),
          create};
}

}  // namespace mlt
