#include "mutation/path_mixture.h"

namespace mlt {

Transition PathMixture::propose_again(const PathState& x, const PathState& y1, PathState& y2,
                                      Rng& rng) {
  if (!proposed() || chosen() >= second_stage_.size() || !second_stage_[chosen()])
    return impossible;
  const Mutation &first_stage = (*this)[chosen()], &second_stage = *second_stage_[chosen()];
  const Edit first = edit();
  MutationContext context(rng, scratch());
  const auto second = second_stage.propose(x, y2, context);
  if (!second || !(y2.target > 0)) return impossible;

  const Transition own = second_stage.quotients(x, y2, *second);
  if (own.forward == 0) return impossible;
  const double forward = first_stage.density(x, y1, first) * probability(x);
  if (!(forward > 0)) return impossible;  // y1 has another form than the mutation makes
  const double backward = first_stage.density(y2, y1, first) * probability(y2);
  return after_rejection({own.forward * forward, own.backward * backward}, first_,
                         first_transition(y2, y1));
}

Transition PathMixture::first_transition(const PathState& x, const PathState& y) {
  if (!generated(y)) return impossible;
  const Transition own = (*this)[chosen()].quotients(x, y, edit());
  if (own.forward == 0) return impossible;
  return {probability(x) * own.forward, probability(y) * own.backward};
}

}  // namespace mlt
