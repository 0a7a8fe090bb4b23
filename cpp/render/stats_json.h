// The schema of stats.json.
#pragma once

#include "integrator/stats.h"

namespace mlt {

std::string to_json(const Stats& stats);

}  // namespace mlt
