// The side of a cylinder around the line from p0 to p1, open at both ends, with its normals outward.
// u is the azimuth, v runs from 0 to 1 along the axis. The default is the unit cylinder over the unit
// circle, from z = 0 to 1.
#include "scene/cylinder.h"

#include "scene/mesh_data.h"
#include "scene/orientation.h"
#include "scene/shape/common.h"
#include "scene/texture.h"

namespace mlt {
namespace {

/// A circle whose two radii differ by more than this is an ellipse, and none that was rounded.
constexpr double max_eccentricity = 1e-3;

ObjectPtr create(Params& params) {
  const Mat4 to_world = matrix_param(params, "to_world");
  const Triple a = params.triple("p0"), b = params.triple("p1");
  const Vec3 p0(a[0], a[1], a[2]), p1(b[0], b[1], b[2]);
  const double radius = params.real("radius");
  if (!(radius > 0)) params.fail("radius", "must be positive");
  const double height = length(p1 - p0);
  if (!(height > 0)) params.fail("p1", "is the same point as 'p0', so the cylinder has no length");
  if (!is_affine(to_world)) params.fail("to_world", "is no affine map");

  const Frame object = Frame::around((p1 - p0) / height);
  const Vec3 x = transform_vector(to_world, object.s) * radius;
  const Vec3 y = transform_vector(to_world, object.t) * radius;
  const Vec3 z = transform_vector(to_world, object.n) * height;
  const Vec3 base = transform_point(to_world, p0);
  const Frame frame =
      orientation(params, "to_world", {Vec4(x, 0), Vec4(y, 0), Vec4(z, 0), Vec4(base, 1)});
  const double rx = length(x), ry = length(y);
  if (std::abs(rx - ry) > max_eccentricity * rx)
    params.fail("to_world",
                "makes the circle of this cylinder an ellipse; both axes across it must have the "
                "same scale (use a mesh instead)");
  auto cylinder = std::make_shared<Cylinder>(base, frame, 0.5 * (rx + ry), length(z),
                                             params.boolean("flip_normals"));
  cylinder->where = params.where();
  return cylinder;
}

}  // namespace

Plugin shape_cylinder() {
  return {shape_schema(
              "cylinder", "The side of a cylinder, open at both ends.",
              {{"p0", ParamType::point, Triple{0, 0, 0}, "Where its axis begins, in object space."},
               {"p1", ParamType::point, Triple{0, 0, 1}, "Where its axis ends."},
               {"radius", ParamType::real, 1.0, "In object space."}}),
          create};
}

}  // namespace mlt
