// Sensors that see along one ray, which no vertex of a walk from a light is on.
#pragma once

#include "scene/scene.h"

namespace mlt {

/// Throws UsageError if light tracing finds nothing, since the sensor sees along one ray.
void refuse_one_ray(const Scene& scene);

}  // namespace mlt
