// A camera with a circular lens: only the plane at the focus distance is sharp.
#include "base/registry.h"
#include "scene/camera/projective.h"

namespace mlt {
namespace {

double positive(Params& params, const std::string& name) {
  const double x = params.real(name);
  if (!(x > 0)) params.fail(name, fmt::format("is {:f}, but must be positive", x));
  return x;
}

ObjectPtr create_thin_lens(Params& params) {
  const ProjectiveCamera::View view = read_shifted_view(params);
  constexpr double far = 1e4;  // of Mitsuba's far_clip by default
  const char* given = params.has("focus_distance") ? "focus_distance" : "far_clip";
  const double focus = params.has(given) ? positive(params, given) : far;
  const double radius = params.real("aperture_radius");
  if (radius < 0) params.fail("aperture_radius", "must not be negative");
  return make_projective(params, view, {radius, focus});
}

}  // namespace

Plugin sensor_thinlens() {
  return {{"sensor", "thinlens", "A camera with depth of field.",
           concat({view_parameters(),
                   clipping_parameters(),
                   {{"aperture_radius", ParamType::real, no_default,
                     "Radius of the lens in scene units; 0 makes it a pinhole."},
                    {"focus_distance", ParamType::real, no_default,
                     "Distance of the plane in focus; by default far_clip, or 10000."}}})},
          create_thin_lens};
}

}  // namespace mlt
