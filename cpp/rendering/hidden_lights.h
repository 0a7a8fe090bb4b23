#pragma once

#include "rendering/stats.h"
#include "scene/scene.h"

namespace mlt {

/// For algorithms whose walks begin at the camera alone: warns of lights of no size behind mirrors
/// or glass, which no such walk can hit, and whose light it can reach from no surface that
/// scatters.
void warn_of_hidden_lights(const Scene& scene, Stats& stats);

}  // namespace mlt
