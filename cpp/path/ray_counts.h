#pragma once

#include "base/abandon.h"

#include <cstdint>

namespace mlt {

/// How many rays a piece of work has traced. Counting them throws Abandoned if the work was
/// abandoned, which is checked now and then.
struct RayCounts {
  uint64_t intersect = 0, occluded = 0;

  uint64_t total() const { return intersect + occluded; }
  void count_intersect(uint64_t rays = 1) { count(intersect, rays); }
  void count_occluded(uint64_t rays = 1) { count(occluded, rays); }
  RayCounts& operator+=(const RayCounts& other) {
    intersect += other.intersect;
    occluded += other.occluded;
    return *this;
  }

 private:
  static void count(uint64_t& sum, uint64_t rays) {
    constexpr int between_checks = 10;  // as a power of two
    const uint64_t before = sum;
    sum += rays;
    if ((before ^ sum) >> between_checks) check_abandoned();
  }
};

}  // namespace mlt
