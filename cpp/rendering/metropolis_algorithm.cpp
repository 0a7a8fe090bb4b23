#include "rendering/metropolis_algorithm.h"

#include "rendering/family_taker.h"

namespace mlt {

std::unique_ptr<SampleTaker> MetropolisAlgorithm::sample_taker(const FamilyWeights& weights) const {
  return std::make_unique<FamilyTaker>(*this, weights);
}

}  // namespace mlt
