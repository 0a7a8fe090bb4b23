#include "scene/transform/orientation.h"

namespace mlt {
namespace {

/// Scenes have matrices with few digits; an angle that is off by more than this is a real shear.
constexpr double max_shear = 1e-3;

Vec3 axis(const Params& params, const std::string& name, const Vec3& column) {
  const double l = length(column);
  if (!(l > 0) || !std::isfinite(l))
    params.fail(name, "is singular; it must turn the three axes into three different directions");
  return column / l;
}

/// A frame with exactly this z; the sign of `volume` is that of its determinant.
Frame perpendicular(const Vec3& x, const Vec3& z, double volume) {
  const Vec3 s = normalize(x - z * dot(x, z));
  return {s, cross(z, s) * std::copysign(1.0, volume), z};
}

}  // namespace

Frame orientation(const Params& params, const std::string& name, const Mat4& to_world) {
  const Vec3 x = axis(params, name, Vec3(to_world[0]));
  const Vec3 y = axis(params, name, Vec3(to_world[1]));
  const Vec3 z = axis(params, name, Vec3(to_world[2]));
  const double volume = dot(cross(x, y), z);
  if (!(std::abs(volume) > 1e-6))
    params.fail(name, "is singular; it must turn the three axes into three different directions");
  const double shear = std::max({std::abs(dot(x, y)), std::abs(dot(y, z)), std::abs(dot(z, x))});
  if (shear > max_shear)
    params.fail(name, "shears; here it may only rotate, mirror, move and scale along its axes");
  return perpendicular(x, z, volume);
}

Motion turning_motion_param(Params& params) {
  const Motion motion = motion_param(params, "to_world");
  for (const Mat4& step : motion.steps()) orientation(params, "to_world", step);
  return motion;
}

Frame turned_axes(const Mat4& to_world) {
  const Vec3 x = normalize(Vec3(to_world[0])), z = normalize(Vec3(to_world[2]));
  return perpendicular(x, z, glm::determinant(Mat3(to_world)));
}

}  // namespace mlt
