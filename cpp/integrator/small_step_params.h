// The parameters of steps in primary sample space.
#pragma once

#include "base/params.h"
#include "primary/small_step.h"

namespace mlt {

std::vector<Parameter> primary_step_parameters();
SmallStep small_step(Params& params);
double large_probability(Params& params);

}  // namespace mlt
