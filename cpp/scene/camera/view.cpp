// The field of view of a projective camera, with Mitsuba's parameters.
#include "scene/camera/projective.h"

#include <charconv>

namespace mlt {
namespace {

/// The diagonal of a frame of 35 mm film (36 mm x 24 mm), to which focal lengths refer.
const double film_diagonal = std::sqrt(36.0 * 36.0 + 24.0 * 24.0);

double focal_length_mm(Params& params) {
  const std::string text = params.text("focal_length");
  double mm = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, mm);
  const std::string unit(rest, end);
  if (error != std::errc() || !(unit.empty() || unit == "mm") || !(mm > 0) || !std::isfinite(mm))
    params.fail("focal_length",
                "is '" + text + "', but should be a positive length such as '50mm'");
  return mm;
}

ProjectiveCamera::View::Axis read_axis(Params& params) {
  using Axis = ProjectiveCamera::View::Axis;
  const std::string axis = params.text("fov_axis");
  if (axis == "y") return Axis::y;
  if (axis == "diagonal") return Axis::diagonal;
  if (axis == "smaller") return Axis::smaller;
  if (axis == "larger") return Axis::larger;
  return Axis::x;
}

}  // namespace

std::vector<Parameter> field_of_view_parameters() {
  return {{"fov", ParamType::real, no_default,
           "Field of view in degrees; if not given, focal_length counts."},
          choice_parameter("fov_axis", "x", "The image axis that fov is measured along.",
                           {"x", "y", "diagonal", "smaller", "larger"}),
          {"focal_length", ParamType::text, std::string("50mm"),
           "Focal length on 35 mm film, of which the image has the same diagonal field of view."}};
}

std::vector<Parameter> view_parameters() {
  return concat({placement_parameters(),
                 field_of_view_parameters(),
                 {{"principal_point_offset_x", ParamType::real, 0.0,
                   "Horizontal shift of the optical axis, as a fraction of the image's width."},
                  {"principal_point_offset_y", ParamType::real, 0.0,
                   "Vertical shift of the optical axis, as a fraction of the image's height."}}});
}

ProjectiveCamera::View read_view(Params& params) {
  ProjectiveCamera::View view;
  if (params.has("fov")) {
    if (params.has("focal_length")) params.fail("focal_length", "and 'fov' exclude each other");
    const double degrees = params.real("fov");
    if (!(degrees > 0 && degrees < 180))
      params.fail("fov", fmt::format("is {:f}, but must lie between 0 and 180 degrees", degrees));
    view.fov = degrees * degree;
    view.axis = read_axis(params);
  } else {
    view.fov = 2 * std::atan(film_diagonal / (2 * focal_length_mm(params)));
    view.axis = ProjectiveCamera::View::Axis::diagonal;
  }
  return view;
}

ProjectiveCamera::View read_shifted_view(Params& params) {
  ProjectiveCamera::View view = read_view(params);
  view.principal_offset = {params.real("principal_point_offset_x"),
                           params.real("principal_point_offset_y")};
  return view;
}

std::vector<Parameter> clipping_parameters() {
  return {{"near_clip", ParamType::real, no_default,
           "Depth of the plane in front of which nothing is seen, nor blocks light; 0 by default."},
          {"far_clip", ParamType::real, no_default,
           "Depth of the plane behind which nothing but lights at infinity is seen; none by "
           "default."}};
}

ClippingPlanes read_clipping(Params& params) {
  ClippingPlanes planes;
  if (params.has("near_clip")) planes.near = params.real_in("near_clip", 0, 1e12);
  if (params.has("far_clip")) planes.far = params.real_in("far_clip", 0, infinity);
  if (!(planes.near < planes.far))
    params.fail("far_clip", "should be greater than near_clip, or nothing is seen");
  return planes;
}

std::shared_ptr<ProjectiveCamera> make_projective(Params& params,
                                                  const ProjectiveCamera::View& view,
                                                  const ProjectiveCamera::Lens& lens) {
  auto camera = std::make_shared<ProjectiveCamera>(read_placement(params), view, lens);
  camera->set_clipping(read_clipping(params));
  return camera;
}

}  // namespace mlt
