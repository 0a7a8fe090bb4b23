#include "scene/emitter/sphere_image.h"

#include "scene/light/brightest_light.h"
#include "scene/texture/load_texels.h"

namespace mlt {

Image load_sphere_image(Params& params) {
  const char* given = params.has("data") ? "data" : "filename";
  Image image = load_image(params, {});
  if (image.width < 2 || image.height < 3)
    params.fail(given, fmt::format("is an image of {} x {} pixels; an image of all directions "
                                   "needs at least 2 x 3",
                                   image.width, image.height));
  for (const float value : image.data)
    if (value > brightest_light)
      params.fail(given, fmt::format("has a pixel of {:g}, but must have at most {:g}", value,
                                     brightest_light));
  return image;
}

double read_scale(Params& params) {
  const double scale = params.real("scale");
  if (scale < 0) params.fail("scale", "must not be negative");
  if (scale > brightest_light)
    params.fail("scale", fmt::format("is {:g}, but must be at most {:g}", scale, brightest_light));
  return scale;
}

}  // namespace mlt
