// The phase function of media for which none is given.
#pragma once

#include "scene/bsdf.h"

namespace mlt {

BsdfPtr isotropic_phase();

}  // namespace mlt
