// A triangle mesh from Mitsuba's compressed binary format.
#include "scene/shape/common.h"
#include "scene/shape/readers.h"

namespace mlt {
namespace {

ObjectPtr create(Params& params) {
  SerializedMesh read =
      read_serialized(read_file(params), params.integer("shape_index"), params.text("filename"));
  return mesh_from_file(params, std::move(read.mesh), read.face_normals);
}

}  // namespace

Plugin shape_serialized() {
  return {shape_schema("serialized", "A mesh from a Mitsuba .serialized file.",
                       {filename_parameter("The .serialized file."),
                        {"shape_index", ParamType::integer, int64_t{0},
                         "Which mesh of the file, counted from 0."},
                        face_normals_parameter()}),
          create};
}

}  // namespace mlt
