// Choosing the mutations by experience (Veach 1997, sec. 11.4.2; Pasarica & Gelman 2010): pilot
// chains measure, for every mutation and path length, the expected squared jump per ray traced. The
// choice probabilities follow it, and are then frozen: the render starts afresh, so nothing is
// biased.
//
// Mutations of several step sizes take part as so many mutations; so the step sizes are chosen as
// well.
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
  double least_share = 0.05;            ///< What every mutation keeps.
  double least_share_of_ergodic = 0.1;  ///< One that makes the chain ergodic keeps more.
};

/// How far y is from x, squared, between 0 and 1: half for the image, where a move counts as whole
/// from 4 pixels on, half for the path's vertices, where it does from 1 % of the scene's radius on.
/// Farther moves do not make a pixel's value any more independent.
double squared_jump(const Scene& scene, const PathState& x, const PathState& y);

/// The probabilities found; `initial` is what the pilot chains use. Deterministic for any number of
/// threads. Returns `initial` if no light path was found, or when cancelled.
MixtureWeights adapt(const PathTarget& target, const Mutations& mutations,
                     const MixtureWeights& initial, const AdaptationSettings& adaptation,
                     const std::atomic<bool>& cancelled);

}  // namespace mlt
