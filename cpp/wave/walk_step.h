// PrimaryStep for walks that are traced side by side: each chain adds its proposal to a wave, and
// takes its step when the wave has been traced.
#pragma once

#include "wave/walk_wave.h"

namespace mlt {

class WalkStep : public PrimaryMoves {
 public:
  WalkStep(double large_probability, bool delayed_rejection)
      : PrimaryMoves(large_probability, delayed_rejection) {}

  /// Adds this stage's proposal to the wave, if there is one.
  void prepare(const PrimaryState& x, Proposals& y, size_t stage, Rng& rng, WalkWave& wave) {
    proposed_[stage] = choose(stage, rng) && (stage == 0 || !(acceptance(quotients(x, y[0])) >= 1));
    if (proposed_[stage])
      wave.add(x, stage == 0 && last() == large, rng.next_bits(), y[stage], rays_);
  }
  /// The transition to this stage's proposal, after it was traced.
  Transition propose(const PrimaryState& x, const Proposals& y, size_t stage, Rng&) const {
    return proposed_[stage] ? quotients(x, y, stage) : impossible;
  }
  RayCounts& rays() { return rays_; }

 private:
  std::array<bool, stages> proposed_{};
  RayCounts rays_;
};

}  // namespace mlt
