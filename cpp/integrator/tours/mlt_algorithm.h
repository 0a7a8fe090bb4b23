// The tours of mlt: their mutations, the weights of these, and the target.
#pragma once

#include "mutation/extra_mutation.h"
#include "mutation/mutation_registry.h"
#include "rendering/metropolis_algorithm.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mlt {

/// A mutation of the registry as a part of the mixture.
struct MixedMutation {
  std::string name;
  double weight;
  MutationValues values = {};
};

struct MltSettings {
  PathRules rules;
  double near_specular = 0.1;
  std::vector<MixedMutation> mixture;
  std::vector<ExtraMutation> extra;
  bool adaptive = true;
  bool two_stage = true;
  bool manifolds = false;  ///< Whether samples join lights across chains (ManifoldSampler).
  bool delayed_rejection = false;
  bool samples_beside = true;         ///< Whether independent samples go to the image, too.
  std::optional<double> tour_length;  ///< Mean steps of a tour, alike for all.
  double spark = 0;                   ///< q of StepsInPixels; 0: no tour waits.
};

std::unique_ptr<MetropolisAlgorithm> mlt_algorithm(ScenePtr scene, const MltSettings& settings);

}  // namespace mlt
