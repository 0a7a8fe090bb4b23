// THE Metropolis-Hastings step (Metropolis et al. 1953, Hastings 1970). Nothing else in pymlt
// accepts or rejects: light paths, primary samples and the one-dimensional examples of the lecture
// are all instances of this template.
//
// A kernel proposes y from x and returns the two quotients that the acceptance needs,
//
//   a(x -> y) = min(1, L*(y) q(y -> x) / (L*(x) q(x -> y))) = min(1, backward / forward),
//   forward = q(x -> y) / L*(y),   backward = q(y -> x) / L*(x),
//
// each up to one factor that both share. Quotients, since factors that q and L* have in common can
// then be cancelled before they overflow.
//
// Both states are recorded with their expected weights, a for y and 1 - a for x, which has the
// same expectation as recording the state that was chosen, and less noise (Veach & Guibas 1997,
// sec. 5.1).
//
// With several stages (delayed rejection, Tierney & Mira 1999) a rejected proposal is followed by
// another; the kernel's quotients for stage 2 contain the probabilities of having been rejected
// before. The weights are a1 for y1, (1 - a1) a2 for y2 and so on, and the rest for x.
#pragma once

#include "base/rng.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace mlt {

struct Transition {
  double forward = std::numeric_limits<double>::infinity();  ///< q(x -> y) / L*(y)
  double backward = 0;                                       ///< q(y -> x) / L*(x)
};

/// No proposal, or one of zero density: always rejected.
inline constexpr Transition impossible{};

/// min(1, backward / forward). NaN if the quotients are invalid.
inline double acceptance(const Transition& t) {
  if (t.forward == std::numeric_limits<double>::infinity()) return 0;
  const double ratio = t.backward / t.forward;
  return ratio >= 1 ? 1.0 : ratio;
}

/// The second stage's quotients (Tierney & Mira 1999, sec. 3): `own` are those without the first
/// stage's rejection, `first` those of y1 proposed from x, and `reverse` those of y1 from y2. The
/// densities q1(x -> y1) and q1(y2 -> y1) are factors of `own`, or equal.
inline Transition after_rejection(const Transition& own, const Transition& first,
                                  const Transition& reverse) {
  if (own.forward == std::numeric_limits<double>::infinity()) return impossible;
  return {own.forward * (1 - acceptance(first)), own.backward * (1 - acceptance(reverse))};
}

struct StepResult {
  double acceptance = 0;  ///< Acceptance of the first stage.
  int accepted = -1;      ///< Stage whose proposal was accepted, or -1.
  bool invalid = false;   ///< Whether a proposal had no valid acceptance (NaN) and was rejected.
};

/// Advances x by one step. `y` is scratch for one proposal per stage; on acceptance x and y are
/// swapped. `kernel.propose(x, y, stage, rng)` fills y[stage] and returns its Transition;
/// `record(state, weight)` receives states whose weights sum to 1.
template <size_t stages, class State, class Kernel, class Record>
StepResult metropolis_step(State& x, std::array<State, stages>& y, Kernel& kernel, Rng& rng,
                           Record&& record) {
  StepResult result;
  double rest = 1;
  for (size_t stage = 0; stage < stages && rest > 0; ++stage) {
    double a = acceptance(kernel.propose(std::as_const(x), y, stage, rng));
    if (!(a >= 0)) {
      result.invalid = true;
      a = 0;
    }
    if (stage == 0) result.acceptance = a;
    if (a > 0) record(std::as_const(y[stage]), rest * a);
    rest *= 1 - a;
    // A stage without a proposal draws no number: whether it is reached may depend on rounding.
    const bool accept = (stage == 0 || a > 0) && rng.next() < a;
    if (accept && result.accepted < 0) result.accepted = static_cast<int>(stage);
  }
  if (rest > 0) record(std::as_const(x), rest);
  if (result.accepted >= 0) std::swap(x, y[result.accepted]);
  return result;
}

}  // namespace mlt
