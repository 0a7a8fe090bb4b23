#pragma once

#include <cstdint>

namespace mlt {

/// How many rays a piece of work has traced.
struct RayCounts {
  uint64_t intersect = 0, occluded = 0;
};

}  // namespace mlt
