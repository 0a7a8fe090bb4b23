// The chains of mmlt and rjmlt: random numbers of one path, and the technique (s, t) that makes it.
#pragma once

#include "primary/multiplexed_step.h"
#include "rendering/metropolis_algorithm.h"

namespace mlt {

struct MultiplexedSettings {
  PathRules rules;
  SmallStep small_step;
  MultiplexedStep::Moves moves;
};

std::unique_ptr<MetropolisAlgorithm> multiplexed_algorithm(ScenePtr scene,
                                                           const MultiplexedSettings& settings);

}  // namespace mlt
