// Primary-sample-space mutations (Kelemen et al. 2002). The state is the vector of uniform numbers;
// the target T is the brightness of what an estimator makes of them.
#pragma once

#include "markov/step.h"
#include "math/color.h"
#include "primary/primary_numbers.h"

#include <vector>

namespace mlt {

/// Light at one position of the image.
struct ImageLight {
  Vec2 raster{0};
  Color rgb{0};           ///< f / p, weighted among techniques.
  bool own_pixel = true;  ///< Where the walk from the camera left the image, not by light tracing.
};

struct PrimaryState {
  PrimaryNumbers numbers;
  std::vector<ImageLight> light;  ///< All that the paths of these numbers add to the image.
  double target = 0;              ///< Sum of L* of it; NaN if the estimator failed.
};

/// Large steps draw all numbers afresh, small steps move each a little. Both are symmetric, so the
/// quotients of the step are the targets alone. `evaluate(state, rng)` makes the state's paths.
///
/// With delayed rejection (Tierney & Mira 1999) a small step follows a large one that was rejected.
/// What a large step proposes does not depend on where it starts, so its density cancels in the
/// second stage's quotient, and the probabilities of having been rejected remain.
template <class PrimaryState, class Evaluate>
class PrimaryStep {
 public:
  using State = PrimaryState;
  static constexpr size_t stages = 2;
  enum Move { large = 0, small = 1 };

  PrimaryStep(double large_probability, bool delayed_rejection, Evaluate evaluate)
      : large_probability_(large_probability),
        delayed_rejection_(delayed_rejection),
        evaluate_(std::move(evaluate)) {}

  Transition propose(const State& x, std::array<State, stages>& y, size_t stage, Rng& rng) {
    if (stage > 0) return propose_again(x, y[0], y[1], rng);
    last_ = rng.next() < large_probability_ ? large : small;
    make(x, last_ == large, y[0], rng);
    return quotients(x, y[0]);
  }

  Move last() const { return last_; }
  static bool generated(const State& y) { return y.target != 0; }
  double large_probability() const { return large_probability_; }
  Evaluate& evaluate() { return evaluate_; }

 private:
  void make(const State& x, bool is_large, State& y, Rng& rng) {
    y.numbers = x.numbers;
    y.numbers.step(is_large);
    evaluate_(y, rng);
  }
  static Transition quotients(const State& x, const State& y) {
    if (!generated(y)) return impossible;
    return {1 / y.target, 1 / x.target};
  }
  Transition propose_again(const State& x, const State& y1, State& y2, Rng& rng) {
    if (!delayed_rejection_ || last_ != large) return impossible;
    make(x, false, y2, rng);
    const Transition own = quotients(x, y2);
    return after_rejection(own, quotients(x, y1), quotients(y2, y1));
  }

  double large_probability_;
  bool delayed_rejection_;
  Evaluate evaluate_;
  Move last_ = large;
};

}  // namespace mlt
