// Light from infinitely far away that an image file describes.
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/environment_map.h"
#include "scene/light/brightest_light.h"
#include "scene/texture/load_texels.h"
#include "scene/texture/texture.h"
#include "scene/transform/orientation.h"
#include "scene/transform/transform_params.h"

namespace mlt {
namespace {

Image load_map(Params& params) {
  Image image = load_image(params, {});
  if (image.width < 2 || image.height < 3)
    params.fail(params.has("data") ? "data" : "filename",
                fmt::format("is an image of {} x {} pixels; an environment map needs at least "
                            "2 x 3",
                            image.width, image.height));
  for (const float value : image.data)
    if (value > brightest_light)
      params.fail(
          params.has("data") ? "data" : "filename",
          fmt::format("has a pixel of {:g}, but must have at most {:g}", value, brightest_light));
  return image;
}

double read_scale(Params& params) {
  const double scale = params.real("scale");
  if (scale < 0) params.fail("scale", "must not be negative");
  if (scale > brightest_light)
    params.fail("scale", fmt::format("is {:g}, but must be at most {:g}", scale, brightest_light));
  return scale;
}

class EnvironmentFile final : public EnvironmentMap {
 public:
  explicit EnvironmentFile(Params& params)
      : EnvironmentMap(load_map(params),
                       orientation(params, "to_world", matrix_param(params, "to_world")),
                       read_scale(params)) {}

  ObjectPtr copy() const override { return std::make_shared<EnvironmentFile>(*this); }
};

}  // namespace

Plugin emitter_envmap() {
  return make_emitter_plugin<EnvironmentFile>(
      "envmap", "Light from infinitely far away, given as a latitude-longitude image.",
      concat({image_parameters("Image file, preferably EXR or HDR."),
              {{"scale", ParamType::real, 1.0, "Multiplies the image."},
               {"to_world", ParamType::transform, no_default,
                "Turns the map; identity if not given."}}}),
      {"mis_compensation", "cache"});
}

}  // namespace mlt
