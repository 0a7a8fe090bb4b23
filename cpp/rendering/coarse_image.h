// What independent samples tell before a Metropolis render.
#pragma once

#include "mutation/target_map.h"
#include "path/found_light.h"
#include "rendering/metropolis_algorithm.h"
#include "rendering/typical_brightness.h"

namespace mlt {

struct CoarseImage {
  explicit CoarseImage(const Raster& raster) : map(blank_image(raster)), typical(raster) {}

  void add(const FoundLight& found) {
    map.add(found.raster, found.weight);
    typical.add(found.raster, found.weight);
    b += found.weight;
  }

  TargetMap map;              ///< For the target of the chains.
  TypicalBrightness typical;  ///< For the pilot.
  double b = 0;               ///< Mean of the weights T / p.
};

/// Draws this number of samples.
CoarseImage coarse_image(const MetropolisAlgorithm& algorithm, const Raster& raster, uint64_t seed,
                         uint64_t samples, int threads, const std::atomic<bool>& cancelled);

}  // namespace mlt
