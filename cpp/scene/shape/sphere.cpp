// A sphere. u is the azimuth about its z axis from +x, v the polar angle from +z.
#include "scene/sphere.h"

#include "scene/shape/common.h"
#include "scene/texture.h"

namespace mlt {
namespace {

ObjectPtr create(Params& params) {
  const Triple c = params.triple("center");
  return std::make_shared<Sphere>(Vec3(c[0], c[1], c[2]), params.real("radius"),
                                  matrix_param(params, "to_world"), params.boolean("flip_normals"),
                                  params.where());
}

}  // namespace

Plugin shape_sphere() {
  return {shape_schema("sphere", "A sphere.",
                       {{"center", ParamType::point, Triple{0, 0, 0}, "In object space."},
                        {"radius", ParamType::real, 1.0, "In object space."}}),
          create};
}

}  // namespace mlt
