// The phase function of a medium.
#pragma once

#include "scene/bsdf/bsdf.h"

namespace mlt {

/// The nested phase function of a medium; the isotropic one if there is none.
BsdfPtr phase_param(Params& params);

}  // namespace mlt
