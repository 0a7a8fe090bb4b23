// The disk of radius 1 in the plane z = 0, with the normal +z. u is the distance from the centre, v
// the azimuth from +x.
#include "scene/disk.h"

#include "scene/shape/common.h"
#include "scene/texture.h"

namespace mlt {
namespace {

ObjectPtr create(Params& params) {
  return std::make_shared<Disk>(matrix_param(params, "to_world"), params.boolean("flip_normals"),
                                params.where());
}

}  // namespace

Plugin shape_disk() {
  return {shape_schema("disk", "A disk of radius 1 in the xy plane that faces +z.", {}), create};
}

}  // namespace mlt
