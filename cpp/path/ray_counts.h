#pragma once

#include <cstdint>

namespace mlt {

/// How many rays a piece of work has traced.
struct RayCounts {
  uint64_t intersect = 0, occluded = 0;

  uint64_t total() const { return intersect + occluded; }
  RayCounts& operator+=(const RayCounts& other) {
    intersect += other.intersect;
    occluded += other.occluded;
    return *this;
  }
};

}  // namespace mlt
