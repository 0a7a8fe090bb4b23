// A pinhole camera.
#include "base/registry.h"
#include "scene/camera/projective.h"

namespace mlt {
namespace {

ObjectPtr create_perspective(Params& params) {
  return make_projective(params, read_shifted_view(params), {});
}

}  // namespace

Plugin sensor_perspective() {
  std::vector<std::string> ignored = {"near_clip", "far_clip", "focus_distance"};
  return {{"sensor", "perspective", "A pinhole camera: everything is in focus.", view_parameters(),
           std::move(ignored)},
          create_perspective};
}

}  // namespace mlt
