// The parameters that say which mutations move chains of light paths.
#pragma once

#include "integrator/mlt_algorithm.h"

namespace mlt {

std::vector<Parameter> mixture_parameters(const std::vector<MutationPlugin>& plugins);
/// Those mutations that are on, at least one.
std::vector<MixedMutation> read_mixture(Params& params, const std::vector<MutationPlugin>& plugins);

}  // namespace mlt
