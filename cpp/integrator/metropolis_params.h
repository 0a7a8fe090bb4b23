// The parameters that Metropolis integrators share.
#pragma once

#include "base/params.h"
#include "integrator/metropolis_rendering.h"

namespace mlt {

/// Of chains that start from a bootstrap, and of tours, which need none;
std::vector<Parameter> chain_parameters(int64_t chains = 128);
std::vector<Parameter> tour_parameters(int64_t chains);
/// of the independent samples beside either.
std::vector<Parameter> family_parameters();
MetropolisSettings metropolis_settings(Params& params);

}  // namespace mlt
