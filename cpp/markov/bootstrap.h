// Starting chains without start-up bias (Veach & Guibas 1997, sec. 5.1): draw candidates by an
// unbiased technique, estimate b = integral of L* from their weights, and start the chains from
// candidates resampled in proportion to these weights. The expectation of b times what the chains
// record is then right from the first step on.
#pragma once

#include "base/rng.h"

#include <cstdint>
#include <vector>

namespace mlt {

struct Bootstrap {
  double b = 0;                 ///< Mean weight of the candidates.
  double b_error = 0;           ///< Its standard error.
  std::vector<uint32_t> seeds;  ///< Index of the candidate that each chain starts from.
};

/// Systematic resampling of `chains` seeds: candidate i is chosen chains * w_i / sum(w) times in the
/// mean. Without any positive weight, `seeds` is empty.
Bootstrap resample(const std::vector<double>& weights, uint32_t chains, Rng& rng);

}  // namespace mlt
