// Choosing the mutations by experience (Veach 1997, sec. 11.4.2; Pasarica & Gelman 2010): pilot
// chains measure, for every mutation and path length, the expected squared jump per ray traced. The
// choice probabilities follow it, and are then frozen: the render starts afresh, so nothing is
// biased.
//
// A mutation with several step sizes counts as one mutation for each of them; so the step sizes are
// chosen as well.
#pragma once

#include "mutation/path_chain.h"

#include <atomic>

namespace mlt {

struct AdaptationSettings {
  uint64_t seed = 0;
  int threads = 1;
  int chains = 64;
  int steps = 1000;
  uint64_t candidates = 8192;
  double least_share = 0.05;            ///< Least probability of any mutation.
  double least_share_of_ergodic = 0.1;  ///< As above, of ergodic ones.
};

/// The squared distance of y from x, between 0 and 1: half for the image, where moves saturate at 4
/// pixels, half for the path's vertices, where they saturate at 1 % of the scene's radius. Farther
/// moves do not make a pixel's value any more independent.
double squared_jump(const Scene& scene, const PathState& x, const PathState& y);

/// The adapted probabilities; the pilot chains use `initial`. Deterministic for any number of
/// threads. Returns `initial` if no light path was found, or when cancelled.
MixtureWeights adapt(const PathTarget& target, const Mutations& mutations,
                     const MixtureWeights& initial, const AdaptationSettings& adaptation,
                     const std::atomic<bool>& cancelled);

}  // namespace mlt
