#include "mutation/proposals.h"

#include "base/error.h"

namespace mlt {

std::vector<Proposal> propose(const PathTarget& target, const Path& path,
                              const MutationPtr& mutation, uint64_t seed, int count) {
  PathState x;
  x.path = path;
  target.evaluate(x);
  if (!(x.target > 0))
    throw UsageError("the path carries no light that the mutation's settings allow");
  if (!(mutation->suitability(x) > 0))
    throw UsageError("the " + mutation->name() + " mutation does not act on a path " +
                     target.signature(path));
  PathChain chain(path_mixture({mutation}, {1.0}), Rng(seed, Purpose::inspect, 0), std::move(x));
  std::vector<Proposal> proposals;
  for (int i = 0; i < count; ++i) {
    const double a = chain.propose();
    if (chain.kernel().generated(chain.other())) proposals.push_back({chain.other(), a});
  }
  return proposals;
}

}  // namespace mlt
