// The mixture of mutations that moves a light path, with delayed rejection: after a rejected
// proposal comes a smaller one (Tierney & Mira 1999; for light transport Rioux-Lavoie et al.
// 2020, "Delayed rejection Metropolis light transport").
//
// With q1 and q2 the densities of both stages and a1 the acceptance of the first, the second
// accepts y2 with
//
//   min(1, L*(y2) q2(y2 -> x) q1(y2 -> y1) (1 - a1(y2 -> y1))
//          / (L*(x) q2(x -> y2) q1(x -> y1) (1 - a1(x -> y1)))).
//
// The second stage comes only where the first has made a path, with or without light: without one
// q1 is not known.
#pragma once

#include "markov/mixture.h"
#include "mutation/mutation.h"

#include <memory>
#include <vector>

namespace mlt {

using MutationPtr = std::shared_ptr<const Mutation>;
using Mutations = std::vector<MutationPtr>;

class PathMixture : public Mixture<const Mutation> {
 public:
  static constexpr size_t stages = 2;

  /// A rejected proposal of mutation i is followed by one of second_stage[i], unless that is
  /// nullptr or missing.
  PathMixture(Mutations moves, std::shared_ptr<const MixtureWeights> weights,
              Mutations second_stage = {})
      : Mixture(std::move(moves), std::move(weights)), second_stage_(std::move(second_stage)) {}

  Transition propose(const PathState& x, std::array<PathState, stages>& y, size_t stage, Rng& rng) {
    if (stage > 0) return propose_again(x, y[0], y[1], rng);
    if (choose(x, rng)) draw(x, y[0], rng);
    return first_ = transition(x, y[0]);
  }

 private:
  Transition propose_again(const PathState& x, const PathState& y1, PathState& y2, Rng& rng);
  /// The transition of the mutation that was chosen for the first stage, from any state.
  Transition first_transition(const PathState& x, const PathState& y);

  Mutations second_stage_;
  Transition first_;  ///< Transition of the first stage.
};

}  // namespace mlt
