// What a light path may be, whichever method makes it.
#pragma once

#include <limits>

namespace mlt {

struct PathRules {
  int max_depth = -1;  ///< Edges of the longest path; 1: lights seen directly; -1: unbounded.
  int min_depth = 1;   ///< Edges of the shortest path.
  int rr_depth = 5;    ///< From this depth on Russian roulette may end a walk.
  static constexpr int no_roulette = std::numeric_limits<int>::max();  ///< As rr_depth: never.
  bool hide_emitters = false;   ///< Leave out lights that the camera sees directly.
  bool strict_normals = false;  ///< See `consistent_sides`.

  int most_edges() const { return max_depth < 0 ? 1 << 16 : max_depth; }
  /// Whether paths of this many edges are to be found.
  bool wants(int edges) const {
    return edges >= min_depth && edges <= most_edges() && !(edges == 1 && hide_emitters);
  }
};

}  // namespace mlt
