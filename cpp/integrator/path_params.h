// The parameters that integrators over paths share, with Mitsuba's names and defaults.
#pragma once

#include "base/params.h"
#include "path/path_rules.h"
#include "path/path_tracer.h"

namespace mlt {

std::vector<Parameter> path_parameters();
PathRules path_rules(Params& params);

}  // namespace mlt
