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
template <class PrimaryState, class Evaluate>
class PrimaryStep {
 public:
  using State = PrimaryState;
  enum Move { large = 0, small = 1 };

  PrimaryStep(double large_probability, Evaluate evaluate)
      : large_probability_(large_probability), evaluate_(std::move(evaluate)) {}

  Transition propose(const State& x, std::array<State, 1>& proposals, size_t, Rng& rng) {
    State& y = proposals[0];
    last_ = rng.next() < large_probability_ ? large : small;
    y.numbers = x.numbers;
    y.numbers.step(last_ == large);
    evaluate_(y, rng);
    if (!generated(y)) return impossible;
    return {1 / y.target, 1 / x.target};
  }

  Move last() const { return last_; }
  static bool generated(const State& y) { return y.target != 0; }
  double large_probability() const { return large_probability_; }
  Evaluate& evaluate() { return evaluate_; }

 private:
  double large_probability_;
  Evaluate evaluate_;
  Move last_ = large;
};

}  // namespace mlt
