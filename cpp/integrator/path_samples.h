// The independent samples of chains of light paths: those from which chains start, and those that
// go to the image, of bidirectional path tracing or of path tracing (SampleTechniques).
#pragma once

#include "rendering/metropolis_algorithm.h"

namespace mlt {

/// The candidates from which chains start.
std::unique_ptr<MetropolisAlgorithm::Source> path_candidates(const PathTarget& target);

/// The samples that go to the image, one by one, for the pilot.
std::unique_ptr<MetropolisAlgorithm::Source> path_samples(const PathTarget& target);

/// The samples that go to the image, side by side where waves support the scene. Those of path
/// tracing do not estimate the brightness, since there may be light they cannot find.
std::unique_ptr<SampleTaker> path_sample_taker(const PathTarget& target,
                                               const ClampingWeights& weights);

}  // namespace mlt
