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
  return {{"sensor",
           "perspective",
           "A pinhole camera: everything is in focus.",
           concat({view_parameters(), clipping_parameters()}),
           {"focus_distance"}},
          create_perspective};
}

}  // namespace mlt
