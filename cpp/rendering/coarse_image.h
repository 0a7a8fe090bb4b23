// What independent samples tell before a Metropolis render.
#pragma once

#include "mutation/target_map.h"
#include "path/found_light.h"
#include "rendering/metropolis_algorithm.h"

#include <algorithm>

namespace mlt {

struct CoarseImage {
  explicit CoarseImage(const Raster& raster) : map(blank_image(raster)) {}

  void add(const FoundLight& found) {
    map.add(found.raster, found.weight);
    b += found.weight;
  }

  TargetMap map;       ///< The brightness of each region.
  double b = 0;        ///< Mean of the weights T / p.
  uint64_t drawn = 0;  ///< Number of samples.
  double share = 1;    ///< The share of a pilot's usual samples that it can afford.
};

/// The part of `count` samples that a pilot takes if it can afford this share, but enough to judge.
inline uint64_t affordable(double share, uint64_t count) {
  constexpr uint64_t least = 128;
  return std::max(std::min(count, least), static_cast<uint64_t>(share * count));
}

/// Draws this number of samples, or fewer if it is cancelled.
CoarseImage coarse_image(const MetropolisAlgorithm& algorithm, const Raster& raster, uint64_t seed,
                         uint64_t samples, int threads, const std::atomic<bool>& cancelled);

}  // namespace mlt
