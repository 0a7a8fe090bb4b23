// What independent samples tell before a Metropolis render.
#pragma once

#include "base/parallel.h"
#include "mutation/target_map.h"
#include "path/found_light.h"
#include "rendering/metropolis_algorithm.h"

#include <algorithm>

namespace mlt {

struct CoarseImage {
  explicit CoarseImage(const Raster& raster) : map(blank_image(raster)) {}

  void add(const FoundLight& found) {
    map.add(found.raster, found.weight, found.certainty);
    b += found.weight;
  }

  TargetMap map;       ///< The brightness of each region.
  double b = 0;        ///< Mean of the weights T / p.
  uint64_t drawn = 0;  ///< Number of samples.
  double share = 1;    ///< The share of a pilot's usual samples that it can afford.
};

/// The number of samples that is enough to judge by.
inline constexpr uint64_t least_of_pilot = 128;

/// The part of `count` samples that a pilot takes if it can afford this share, but enough to judge.
inline uint64_t affordable(double share, uint64_t count) {
  return std::max(std::min(count, least_of_pilot), static_cast<uint64_t>(share * count));
}

/// Whether one of the parts of a pilot (in_parts) that has drawn so many samples draws more: when
/// it is late, too, until all parts have drawn enough to judge by.
inline bool goes_on(uint64_t drawn, const std::atomic<bool>& late) {
  return drawn < least_of_pilot / part_count || !late;
}

/// Draws this number of samples, or fewer if it is late.
CoarseImage coarse_image(const MetropolisAlgorithm& algorithm, const Raster& raster, uint64_t seed,
                         uint64_t samples, int threads, const std::atomic<bool>& late);

}  // namespace mlt
