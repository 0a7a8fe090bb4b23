// Images of what comes from, or goes into, all directions.
#pragma once

#include "base/params.h"
#include "image/image.h"

namespace mlt {

/// The image of `filename` or `data`, in the layout of EnvironmentMap. Throws SceneError if it has
/// fewer than 2 x 3 pixels, or one that is brighter than lights may be.
Image load_sphere_image(Params& params);

/// The parameter `scale`, a factor of the image. Throws SceneError if it is below 0 or too bright.
double read_scale(Params& params);

}  // namespace mlt
