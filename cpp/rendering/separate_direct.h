// Direct light rendered apart from the chains, by the integrator that is best at it.
#pragma once

#include "rendering/integrator.h"

namespace mlt {

/// Light that is added to what the chains make.
struct SeparateDirect {
  std::unique_ptr<Rendering> rendering;  ///< nullptr: there is none.
  double spp = 0;
};

/// Light of at most one reflection, `samples` per pixel; none at all if samples is 0.
SeparateDirect separate_direct(ScenePtr scene, uint64_t seed, int samples, bool hide_emitters,
                               bool strict_normals);

}  // namespace mlt
