// Proposals of one mutation from a path, for inspection: none is accepted.
#pragma once

#include "mutation/path_chain.h"

#include <memory>
#include <vector>

namespace mlt {

struct Proposal {
  PathState path;
  double acceptance = 0;  ///< min(1, L*(y) q(y -> x) / (L*(x) q(x -> y)))
};

/// Up to `count` proposals of a mutation that acts alone; tries that find no path are left out.
/// Throws UsageError if the path carries no light or does not suit the mutation.
std::vector<Proposal> propose(const PathTarget& target, const Path& path,
                              const MutationPtr& mutation, uint64_t seed, int count);

}  // namespace mlt
