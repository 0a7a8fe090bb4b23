// Light from infinitely far away that an image file describes.
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/environment_map.h"
#include "scene/emitter/sphere_image.h"
#include "scene/texture/load_texels.h"
#include "scene/transform/orientation.h"
#include "scene/transform/transform_params.h"

namespace mlt {
namespace {

class EnvironmentFile final : public EnvironmentMap {
 public:
  explicit EnvironmentFile(Params& params)
      : EnvironmentMap(load_sphere_image(params),
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
