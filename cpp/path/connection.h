// One path that bidirectional path tracing has found.
#pragma once

#include "math/color.h"
#include "math/vec.h"

namespace mlt {

class Emitter;

/// How a path is made: s vertices by a walk from the light, t by one from the camera.
struct Technique {
  int s = 0, t = 0;

  int edges() const { return s + t - 1; }
};

/// One path found by technique (s, t).
struct Connection {
  int s, t;
  Vec2 raster;
  Color contribution;  ///< f / p as a film records it, without the weight.
  double weight;
  const Emitter* emitter = nullptr;  ///< The light of a path with s = 0.
  /// The factor that turns the contribution into f / P, with P the density of all techniques.
  double own_share = 0;
  double survival = 1;     ///< Probability of both subpaths in Russian roulette.
  bool assembled = false;  ///< Whether the sampler keeps the path, and not only its subpaths.
  /// For a path found by ManifoldSampler the number of searches that have found it again, and what
  /// its contribution is multiplied by since the probability of finding it is estimated.
  int searches = 0;
  double found_again = 1;
  double certainty = 0;  ///< See certainty() of path_terms.h.
};

}  // namespace mlt
