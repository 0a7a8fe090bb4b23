// Direct light rendered apart from the chains, by the integrator that is best at it.
#pragma once

#include "rendering/metropolis_rendering.h"

namespace mlt {

/// Renders light of at most one reflection with `samples` per pixel; nothing if samples is 0.
/// Throws UsageError where it would not find some of that light.
SeparateDirect separate_direct(ScenePtr scene, uint64_t seed, int samples, bool hide_emitters,
                               bool strict_normals, const LightLayerSettings& light);

}  // namespace mlt
