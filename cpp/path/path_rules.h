// The rules that light paths obey, whatever technique makes them.
#pragma once

#include <algorithm>
#include <limits>

namespace mlt {

struct PathRules {
  int max_depth = -1;  ///< Edges of the longest path; 1: lights seen directly; -1: unbounded.
  int min_depth = 1;   ///< Edges of the shortest path.
  int rr_depth = 5;    ///< From this depth on Russian roulette may end a walk.
  static constexpr int no_roulette = std::numeric_limits<int>::max();  ///< As rr_depth: never.
  bool hide_emitters = false;       ///< Leave out lights that the camera sees directly.
  bool strict_normals = false;      ///< See `consistent_sides`.
  bool equiangular = false;         ///< Path tracing in media has the technique of approach.h, too.
  bool through_boundaries = false;  ///< Likewise that of refracted_light.h.
  /// Whether waves (cpp/wave) make the paths where they can; else cpp/path, one by one.
  bool waves = true;

  /// The probability of surviving Russian roulette, by a factor of the throughput.
  static double survival(double factor) { return std::min(factor, 0.95); }

  /// The bound on edges also where max_depth is -1: vertices take memory, and the techniques of all
  /// lengths its square. Russian roulette lets one of 10^90 walks come so far.
  static constexpr int longest = 1 << 12;
  int most_edges() const { return max_depth < 0 ? longest : std::min(max_depth, longest); }
  /// Whether paths with this number of edges are rendered.
  bool wants(int edges) const {
    return edges >= min_depth && edges <= most_edges() && !(edges == 1 && hide_emitters);
  }
};

}  // namespace mlt
