// Starting chains without start-up bias (Veach & Guibas 1997, sec. 5.1): draw candidates by an
// unbiased technique, estimate b = integral of L* from their weights, and start the chains from
// candidates resampled in proportion to these weights. Then b times the recorded states has the
// right expectation from the first step on.
#pragma once

#include "base/parallel.h"
#include "base/rng.h"

#include <atomic>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace mlt {

struct Bootstrap {
  double b = 0;                 ///< Mean weight of the candidates.
  double b_error = 0;           ///< Standard error of b.
  std::vector<uint32_t> seeds;  ///< Index of the candidate that each chain starts from.
};

/// Systematic resampling of `chains` seeds: candidate i is chosen chains * w_i / sum(w) times in
/// the mean. Without any positive weight, `seeds` is empty.
Bootstrap resample(const std::vector<double>& weights, uint32_t chains, Rng& rng);

/// Numbered candidates; each has a random stream of its own, and can be drawn again.
struct Candidates {
  uint64_t seed;
  Purpose purpose;
  uint64_t count;

  Rng rng(uint64_t i) const { return Rng(seed, purpose, i); }
};

/// The results of `draw(*source, rng)` for all candidates. `make_source()` returns a pointer to a
/// source that draws them one after the other. When `cancelled` the other results have their
/// default values. `finished(*source)` is called by one thread after the other.
template <class MakeSource, class Draw, class Finished>
auto draw_candidates(const Candidates& candidates, int threads, const std::atomic<bool>& cancelled,
                     MakeSource&& make_source, Draw&& draw, Finished&& finished) {
  using Drawn = decltype(draw(*make_source(), std::declval<Rng&>()));
  std::vector<Drawn> drawn(candidates.count);
  std::mutex mutex;
  parallel_blocks(threads, candidates.count, [&](uint64_t first, uint64_t last) {
    const auto source = make_source();
    for (uint64_t i = first; i < last && !cancelled; ++i) {
      Rng rng = candidates.rng(i);
      drawn[i] = draw(*source, rng);
    }
    const std::lock_guard lock(mutex);
    finished(*source);
  });
  return drawn;
}

}  // namespace mlt
