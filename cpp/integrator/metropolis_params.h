// The parameters that Metropolis integrators share.
#pragma once

#include "base/params.h"
#include "integrator/metropolis_rendering.h"

namespace mlt {

std::vector<Parameter> metropolis_parameters();
MetropolisSettings metropolis_settings(Params& params);

}  // namespace mlt
