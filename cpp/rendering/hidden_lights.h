#pragma once

#include "rendering/stats.h"
#include "scene/scene.h"

namespace mlt {

/// Warns of lights of no size behind mirrors or glass, for algorithms whose walks begin at the
/// camera alone: no such walk can hit these lights, nor connect to them from a surface that
/// scatters.
void warn_of_hidden_lights(const Scene& scene, Stats& stats);

}  // namespace mlt
