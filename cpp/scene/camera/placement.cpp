#include "scene/camera/placement.h"

#include "scene/texture/texture.h"
#include "scene/transform/orientation.h"

namespace mlt {

PlacedCamera::PlacedCamera(const Placement& placement)
    : pose_{placement.position, placement.axes}, motion_(placement.motion) {
  shutter_ = placement.shutter;
}

PlacedCamera::Pose PlacedCamera::moved_pose(double time) const {
  const Mat4 to_world = motion_.at(time);
  const Frame axes = turned_axes(to_world);
  return {Vec3(to_world[3]) - axes.n * setback_, axes};
}

std::vector<Parameter> shutter_parameters() {
  return {{"shutter_open", ParamType::real, 0.0, "Time at which the shutter opens."},
          {"shutter_close", ParamType::real, 0.0, "Time at which the shutter closes."},
          {"exposures", ParamType::integer, int64_t{1},
           "How many times the shutter opens between these times, at equal distances."},
          {"exposure_share", ParamType::real, 1.0,
           "The share of the time from one exposure to the next for which the shutter is open."}};
}

Shutter read_shutter(Params& params) {
  const Shutter shutter{params.real("shutter_open"), params.real("shutter_close"),
                        static_cast<int>(params.integer_in("exposures", 1, 1 << 20)),
                        params.real_in("exposure_share", 0, 1)};
  if (shutter.close < shutter.open) params.fail("shutter_close", "is before shutter_open");
  return shutter;
}

std::vector<Parameter> placement_parameters() {
  return concat(
      {{{"to_world", ParamType::motion, no_default,
         "Camera space to world space: the camera looks along +z, +y is up and +x is to the left. "
         "Identity if not given."}},
       shutter_parameters()});
}

Placement read_placement(Params& params) {
  const Shutter shutter = read_shutter(params);
  const Motion motion = motion_param(params, "to_world", shutter);
  for (const Mat4& step : motion.steps()) orientation(params, "to_world", step);
  const Mat4& to_world = motion.steps()[0];
  return {transform_point(to_world, Vec3(0)), orientation(params, "to_world", to_world), shutter,
          motion};
}

}  // namespace mlt
