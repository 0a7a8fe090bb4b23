// The parameters that Metropolis integrators share.
#pragma once

#include "base/params.h"
#include "integrator/metropolis_rendering.h"

namespace mlt {

std::vector<Parameter> metropolis_parameters(int64_t chains = 128);
MetropolisSettings metropolis_settings(Params& params);

}  // namespace mlt
