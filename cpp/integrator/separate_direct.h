// Direct light rendered apart from the chains, by the integrator that is best at it.
#pragma once

#include "integrator/metropolis_rendering.h"

namespace mlt {

/// Light of at most one reflection, `samples` per pixel; none at all if samples is 0.
Aside separate_direct(ScenePtr scene, uint64_t seed, int samples, bool hide_emitters,
                      bool strict_normals);

}  // namespace mlt
