// A pinhole camera.
#include "base/registry.h"
#include "scene/camera/projective.h"

namespace mlt {
namespace {

std::vector<Parameter> parameters() {
  std::vector<Parameter> all = view_parameters();
  all.push_back({"principal_point_offset_x", ParamType::real, 0.0,
                 "Horizontal shift of the optical axis, as a fraction of the image's width."});
  all.push_back({"principal_point_offset_y", ParamType::real, 0.0,
                 "Vertical shift of the optical axis, as a fraction of the image's height."});
  return all;
}

ObjectPtr create(Params& params) {
  ProjectiveCamera::View view = read_view(params);
  view.principal_offset = {params.real("principal_point_offset_x"),
                           params.real("principal_point_offset_y")};
  return make_projective(params, view, {});
}

}  // namespace

Plugin sensor_perspective() {
  return {{"sensor",
           "perspective",
           "A pinhole camera: everything is in focus.",
           parameters(),
           {"near_clip", "far_clip", "focus_distance"}},
          create};
}

}  // namespace mlt
