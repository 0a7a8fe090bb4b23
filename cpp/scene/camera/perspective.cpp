// A pinhole camera.
#include "base/registry.h"
#include "scene/camera/projective.h"

namespace mlt {
namespace {

ObjectPtr create_perspective(Params& params) {
  ProjectiveCamera::View view = read_view(params);
  view.principal_offset = {params.real("principal_point_offset_x"),
                           params.real("principal_point_offset_y")};
  return make_projective(params, view, {});
}

}  // namespace

Plugin sensor_perspective() {
  std::vector<std::string> ignored = {"near_clip", "far_clip", "focus_distance"};
  return {{"sensor", "perspective", "A pinhole camera: everything is in focus.",
           concat({view_parameters(),
                   {{"principal_point_offset_x", ParamType::real, 0.0,
                     "Horizontal shift of the optical axis, as a fraction of the image's width."},
                    {"principal_point_offset_y", ParamType::real, 0.0,
                     "Vertical shift of the optical axis, as a fraction of the image's height."}}}),
           std::move(ignored)},
          create_perspective};
}

}  // namespace mlt
