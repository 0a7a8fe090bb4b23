// Chains of light paths, moved by a mixture of mutations: used by mlt to render and to adapt its
// weights, by the audit and by Python.
#pragma once

#include "markov/chain.h"
#include "mutation/path_mixture.h"

namespace mlt {

/// Paths of more edges than this share a row of weights and of statistics.
constexpr size_t longest_row = 16;

using PathChain = Chain<PathState, PathMixture, PathMixture::stages>;

/// The mixture of mutations with one weight each.
inline PathMixture path_mixture(const Mutations& mutations, std::vector<double> weights) {
  return {mutations, std::make_shared<MixtureWeights>(std::move(weights))};
}

}  // namespace mlt
