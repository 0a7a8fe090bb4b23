// What sensors of a single value have in common.
#pragma once

#include "scene/camera/projective.h"

namespace mlt {

/// Half the image's size at unit distance where it stands for a single direction.
inline constexpr double narrow_view = 0x1p-24;

/// Throws SceneError if the film of the sensor has more than one pixel, or a wide filter.
void require_one_pixel(const Camera& sensor, const Raster& raster);

/// The unit vector of a parameter. Throws SceneError if it has no length.
Vec3 direction_param(Params& params, const std::string& name);

}  // namespace mlt
