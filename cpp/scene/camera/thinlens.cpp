// A camera with a circular lens: only the plane at the focus distance is sharp.
#include "base/registry.h"
#include "scene/camera/projective.h"

namespace mlt {
namespace {

std::vector<Parameter> parameters() {
  std::vector<Parameter> all = view_parameters();
  all.push_back({"aperture_radius",
                 ParamType::real,
                 {},
                 "Radius of the lens in scene units; 0 makes it a pinhole."});
  all.push_back({"focus_distance",
                 ParamType::real,
                 {},
                 "Distance of the plane in focus; far_clip if not given."});
  all.push_back({"far_clip", ParamType::real, 1e4,
                 "Only the default of focus_distance; nothing is clipped."});
  return all;
}

double positive(Params& params, const std::string& name) {
  const double x = params.real(name);
  if (!(x > 0)) params.fail(name, "is " + std::to_string(x) + ", but must be positive");
  return x;
}

ObjectPtr create(Params& params) {
  const ProjectiveCamera::View view = read_view(params);
  const double far_clip = positive(params, "far_clip");
  const double focus = params.has("focus_distance") ? positive(params, "focus_distance") : far_clip;
  const double radius = params.real("aperture_radius");
  if (radius < 0) params.fail("aperture_radius", "must not be negative");
  return make_projective(params, view, {radius, focus});
}

}  // namespace

Plugin sensor_thinlens() {
  return {{"sensor", "thinlens", "A camera with depth of field.", parameters(), {"near_clip"}},
          create};
}

}  // namespace mlt
