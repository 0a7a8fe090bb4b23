// Techniques of bidirectional path tracing in a row, with a name for each.
#pragma once

#include <string>
#include <vector>

namespace mlt {

/// The index of (s, t) among all techniques with s + t - 1 <= max_depth: by length, then by s.
inline int technique_index(int s, int t) {
  const int k = s + t - 1;
  return (k - 1) * (k + 4) / 2 + s;  // there are k + 2 techniques for k edges
}
/// The names of all techniques: "s0.t2", "s1.t1", "s2.t0", "s0.t3", ...
inline std::vector<std::string> technique_names(int max_depth) {
  std::vector<std::string> names;
  for (int k = 1; k <= max_depth; ++k)
    for (int s = 0; s <= k + 1; ++s)
      names.push_back("s" + std::to_string(s) + ".t" + std::to_string(k + 1 - s));
  return names;
}

}  // namespace mlt
