// The pilot of a Metropolis render: a few independent samples and short chains, which estimate the
// noise and the cost of both families. Their paths are not used again, so nothing is biased.
#pragma once

#include "rendering/metropolis_algorithm.h"
#include "rendering/typical_brightness.h"

#include <limits>
#include <optional>

namespace mlt {

/// How a render divides its time between chains and independent samples.
struct Allocation {
  double share = 0;       ///< Share of the time for independent samples; 1: there are no chains.
  FamilyWeights weights;  ///< Weights of both families.
  double mutations_per_sample = 1;                      ///< Cost of an independent sample.
  SampleTechniques techniques = SampleTechniques::all;  ///< Used by the samples.
  bool in_time = true;                                  ///< Whether there was time to find it.
  double b = 0;                                         ///< A rough estimate of b, for tours.
  double steps_per_sample = 1;  ///< Mean number of steps of tours per sample.
};

struct PilotSettings {
  uint64_t seed = 0;
  int threads = 1;
  uint64_t samples = 0;  ///< Candidates for the starts of chains, and as many samples.
  int chains = 64;
  /// Steps of each chain. In more steps some chain gets stuck, and chains seem noisier than they
  /// are.
  uint64_t steps = 500;
  std::optional<double> share;                 ///< See Allocation; fixed if given.
  std::optional<SampleTechniques> techniques;  ///< See Allocation; fixed if given.
  /// Bounds of the share of the independent samples, as long as there are chains.
  double least_share = 0.05, greatest_share = 0.95, greatest_share_with_rare_light = 0.5;
};

/// The division of a render without chains.
inline Allocation samples_alone(SampleTechniques techniques) {
  return {1, FamilyWeights(std::numeric_limits<double>::max()), 1, techniques};
}

/// Finds the division of time with the smallest expected noise, relative to the brightness of
/// each region. Without any light for chains to start from, samples are left alone.
Allocation allocate(MetropolisAlgorithm& algorithm, const Raster& raster,
                    const TypicalBrightness& typical, const PilotSettings& settings,
                    const std::atomic<bool>& cancelled);

}  // namespace mlt
