// Primary-sample-space mutations (Kelemen et al. 2002). The state is the vector of uniform numbers;
// the target T is the brightness of an estimator's light for them.
#pragma once

#include "markov/step.h"
#include "math/color.h"
#include "path/found_light.h"
#include "path/ray_counts.h"
#include "primary/primary_samples.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mlt {

struct PrimaryState {
  PrimarySamples numbers;
  std::vector<ImageLight> light;  ///< Light of all paths of these numbers.
  double target = 0;              ///< Sum of L* of `light`; NaN if the estimator failed.

  /// Adds the light of a path, which is divided by `unit` where it is at the sample's own position:
  /// there all light of the same layers is one entry.
  void add(const ImageLight& found, double unit) {
    if (is_black(found.rgb)) return;
    if (!found.own_pixel) return light.push_back(found);
    const auto is_own = [&](const ImageLight& one) {
      return one.own_pixel && one.layers == found.layers;
    };
    const auto own = std::find_if(light.rbegin(), light.rend(), is_own);
    if (own != light.rend())
      own->rgb += found.rgb / unit;
    else
      light.push_back({found.raster, found.rgb / unit, true, found.layers});
  }
  void find_target() {
    target = 0;
    for (const ImageLight& one : light)
      target += min_component(one.rgb) >= 0 ? target_luminance(one.rgb) : std::nan("");
    if (!std::isfinite(target)) target = std::nan("");
  }
};

/// Large steps draw all numbers afresh, small steps move each a little. Both are symmetric, so the
/// quotients of the step are the targets alone.
///
/// With delayed rejection (Tierney & Mira 1999) a small step follows a large one that was rejected.
/// The proposal of a large step does not depend on the state, so its density cancels in the
/// second stage's quotient, and only the probabilities of rejection remain.
class PrimaryMoves {
 public:
  using State = PrimaryState;
  static constexpr size_t stages = 2;
  enum Move { large = 0, small = 1 };

  PrimaryMoves(double large_probability, bool delayed_rejection)
      : large_probability_(large_probability), delayed_rejection_(delayed_rejection) {}

  Move last() const { return last_; }
  static bool generated(const State& y) { return y.target != 0; }
  double large_probability() const { return large_probability_; }

 protected:
  using Proposals = std::array<State, stages>;

  /// Chooses the kind of step for this stage; false if there is none.
  bool choose(size_t stage, Rng& rng) {
    if (stage > 0) return delayed_rejection_ && last_ == large;
    last_ = rng.next() < large_probability_ ? large : small;
    return true;
  }
  /// The quotients of this stage, once its proposal is known.
  static Transition quotients(const State& x, const Proposals& y, size_t stage) {
    if (stage == 0) return quotients(x, y[0]);
    return after_rejection(quotients(x, y[1]), quotients(x, y[0]), quotients(y[1], y[0]));
  }
  static Transition quotients(const State& x, const State& y) {
    if (!generated(y)) return impossible;
    return {1 / y.target, 1 / x.target};
  }

 private:
  double large_probability_;
  bool delayed_rejection_;
  Move last_ = large;
};

/// `evaluate(x, y, rng)` makes the paths of y by PrimarySampler(x, y.numbers, ...); its `rays` are
/// those that it has traced.
template <class Evaluate>
class PrimaryStep : public PrimaryMoves {
 public:
  PrimaryStep(double large_probability, bool delayed_rejection, Evaluate evaluate)
      : PrimaryMoves(large_probability, delayed_rejection), evaluate_(std::move(evaluate)) {}

  Transition propose(const PrimaryState& x, Proposals& y, size_t stage, Rng& rng) {
    if (!choose(stage, rng)) return impossible;
    evaluate_(stage == 0 && last() == large ? nullptr : &x.numbers, y[stage], rng);
    return quotients(x, y, stage);
  }
  RayCounts& rays() { return evaluate_.rays; }

 private:
  Evaluate evaluate_;
};

}  // namespace mlt
