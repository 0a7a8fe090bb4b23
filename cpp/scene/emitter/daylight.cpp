#include "scene/emitter/daylight.h"

#include "math/warp.h"
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/sky_model.h"
#include "scene/texture/texture.h"
#include "scene/transform/orientation.h"
#include "scene/transform/transform_params.h"

namespace mlt {
namespace {

Frame axes_of(Params& params) {
  return orientation(params, "to_world", matrix_param(params, "to_world"));
}

double read_turbidity(Params& params) { return params.real_in("turbidity", 1, 10); }

/// The share of the horizon's radiance at an angle below it: 0, or fading towards the nadir.
double share_below(double theta, bool extend) {
  if (!extend) return 0;
  const double x = std::clamp(2 - 2 * theta * inv_pi, 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

Image bake(Params& params, double scale) {
  const Vec3 sun = read_sun_position(params);
  const SkyModel model(read_turbidity(params), color_param(params, "albedo"), std::asin(sun.y));
  const auto width = static_cast<int>(params.integer_in("resolution", 4, 4096));
  const double stretch = params.real_in("stretch", 1, 2);
  const bool extend = params.boolean("extend");
  Image image(width, std::max(3, width / 2), 3);
  for (int y = 0; y < image.height; ++y) {
    const double row = pi * y / (image.height - 1);
    const double theta = std::min(row / stretch, pi / 2);
    const double share = row / stretch < pi / 2 ? 1 : share_below(row, extend);
    for (int x = 0; x < width; ++x) {
      const double phi = 2 * pi * (x + 0.5) / width;
      const Vec3 w(std::sin(theta) * std::sin(phi), std::cos(theta),
                   -std::sin(theta) * std::cos(phi));
      const double gamma = std::atan2(length(cross(w, sun)), dot(w, sun));
      const Color color = model.radiance(std::max(0.0, w.y), gamma) * (share * scale);
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(color[c]);
    }
  }
  return image;
}

}  // namespace

Sky::Sky(Params& params, const char* scale)
    : EnvironmentMap(bake(params, params.real_in(scale, 0, 1e9)), axes_of(params), 1) {}

Sun::Sun(Params& params, const char* scale) {
  const Vec3 sun = read_sun_position(params);
  axes_ = Frame::around(axes_of(params).to_world(sun));
  const double radius = sun_radius * params.real_in("sun_radius_scale", 0, 300);
  height_ = 2 * sqr(std::sin(radius / 2));
  const double solid_angle = 4 * pi * sqr(std::sin(sun_radius / 2));
  irradiance_ = sun_radiance(std::acos(sun.y), read_turbidity(params)) *
                (solid_angle * params.real_in(scale, 0, 1e9));
}

bool Sun::contains(const SurfacePoint& x0) const {
  // 1 - cos of the angle between the two, without cancellation.
  return 0.5 * length_squared(x0.p - axes_.n) <= height_ * (1 + 1e-12);
}

Spectrum Sun::eval(const SurfacePoint& x0, const Vec3&) const {
  const double density = delta() ? 1 : contains(x0) ? cone_pdf(height_) : 0;
  return spectrum_of(irradiance_ * density, RgbMeaning::light, x0.wavelength);
}

PositionSample Sun::sample_position(const Vec2& u, double) const {
  if (delta()) return {point_towards(axes_.n), 1};
  return {point_towards(axes_.to_world(sample_cone(u, height_))), cone_pdf(height_)};
}

double Sun::pdf_position(const SurfacePoint& x0) const {
  if (delta()) return 1;
  return contains(x0) ? cone_pdf(height_) : 0;
}

Vec2 Sun::invert_position(const SurfacePoint& x0) const {
  return delta() ? Vec2(0.5) : invert_cone(axes_.to_local(x0.p), height_);
}

namespace {

std::vector<Parameter> common_parameters() {
  return concat({{{"turbidity", ParamType::real, 3.0,
                   "How hazy the air is, from 1 to 10: 2 is clear, 10 is foggy."}},
                 sun_position_parameters(),
                 {{"to_world", ParamType::transform, no_default,
                   "Turns the sky, in which y is up, -z is north and x is east."}}});
}

std::vector<Parameter> sky_parameters() {
  return {{"albedo", ParamType::reflectance, 0.2, "Reflectance of the ground."},
          {"stretch", ParamType::real, 1.0,
           "From 1 to 2: stretches the sky over the horizon towards the nadir."},
          {"extend", ParamType::boolean, false, "Goes on below the horizon, fading."},
          {"resolution", ParamType::integer, int64_t{512}, "Width of its map, in pixels."}};
}

std::vector<Parameter> sun_parameters() {
  return {{"sun_radius_scale", ParamType::real, 1.0,
           "Size of the disk, which does not change its irradiance; 0 is a delta of direction."}};
}

std::vector<Parameter> scale_parameter(const char* name) {
  return {{name, ParamType::real, 1.0, "A factor of the radiance."}};
}

}  // namespace

Plugin emitter_sky() {
  return emitter_plugin("sky", "The sky of a clear day, without the sun.",
                        concat({common_parameters(), sky_parameters(), scale_parameter("scale")}),
                        {}, [](Params& params) { return std::make_shared<Sky>(params, "scale"); });
}

Plugin emitter_sun() {
  return emitter_plugin("sun", "The sun, seen through the air of a clear day.",
                        concat({common_parameters(), sun_parameters(), scale_parameter("scale")}),
                        {}, [](Params& params) { return std::make_shared<Sun>(params, "scale"); });
}

Plugin emitter_sunsky() {
  return {{"emitter", "sunsky", "The sun and the sky of a clear day.",
           concat({common_parameters(),
                   sky_parameters(),
                   sun_parameters(),
                   scale_parameter("sun_scale"),
                   scale_parameter("sky_scale"),
                   {sampling_weight_parameter()}})},
          [](Params& params) -> ObjectPtr {
            auto lights = std::make_shared<Lights>();
            lights->all = {std::make_shared<Sky>(params, "sky_scale"),
                           std::make_shared<Sun>(params, "sun_scale")};
            for (const EmitterPtr& light : lights->all)
              light->set_sampling_weight(read_sampling_weight(params));
            return lights;
          }};
}

}  // namespace mlt
