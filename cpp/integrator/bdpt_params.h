// The parameters of bidirectional integrators.
#pragma once

#include "base/params.h"
#include "path/bidirectional_sampler.h"

namespace mlt {

std::vector<Parameter> bidirectional_parameters();
/// Reads these and the path parameters.
BidirectionalSettings bidirectional_settings(Params& params);

/// Techniques (s, t) with s + t - 1 <= max_depth in a row: by length, then by s.
inline int technique_index(int s, int t) {
  const int k = s + t - 1;
  return (k - 1) * (k + 4) / 2 + s;  // there are k + 2 techniques for k edges
}
/// "s0.t2", "s1.t1", "s2.t0", "s0.t3", ...
std::vector<std::string> technique_names(int max_depth);

}  // namespace mlt
