#pragma once

#include "rendering/stats.h"
#include "scene/scene.h"

namespace mlt {

/// A light of no size, if the lens is the surface of a shape: walks from the camera do not find
/// what falls on it straight from there. nullptr if there is none.
const Emitter* lamp_on_lens(const Scene& scene);

/// For algorithms whose walks begin at the camera alone: warns of lights that these can neither hit
/// nor connect to, which shine along their normals alone, or have no size and are behind mirrors or
/// glass.
void warn_of_hidden_lights(const Scene& scene, Stats& stats);

}  // namespace mlt
