#include "mutation/path_seeds.h"

namespace mlt {

PathStarts bootstrap(const PathTarget& target, const Candidates& candidates, uint32_t chains,
                     int threads, const std::atomic<bool>& cancelled) {
  const std::vector<double> weights = draw_candidates(
      candidates, threads, cancelled, [&] { return std::make_unique<PathSeeds>(target); },
      [](PathSeeds& seeds, Rng& rng) { return seeds.weigh(rng); }, [](const PathSeeds&) {});
  Rng rng = candidates.rng(candidates.count);
  const Bootstrap found = resample(weights, chains, rng);
  PathStarts starts{found.b, found.b_error, std::vector<PathState>(found.seeds.size())};
  parallel_for(threads, starts.paths.size(), [&](uint64_t i) {
    starts.paths[i] = target.seeds().pick(candidates.rng(found.seeds[i]),
                                          candidates.rng(candidates.count + 1 + i));
  });
  return starts;
}

}  // namespace mlt
