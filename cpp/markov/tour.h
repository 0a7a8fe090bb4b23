// Tours: Markov chains that start over and over (Restore: Q. Wang, M. Pollock, G. Roberts, D.
// Steinsaltz, "Regeneration-enriched Markov processes with application to Monte Carlo", 2021; for
// light transport P. Holl, H.-P. Seidel, G. Singh, "Jump Restore light transport", 2025).
//
// Samples find states with density P, and from each a tour starts. In a state x with the target
// T(x) it dies with probability kappa / (1 + kappa), else a step follows that leaves T unchanged:
//
//   kappa(x) = kappa0 P(x) / T(x)
//
// Let nu be the density, per sample, of the states from which a step is made, and K the step. Tours
// visit x as often as they start there or step there, P + nu K, and go on from there with
// probability 1 / (1 + kappa):
//
//   nu (1 + kappa) = P + nu K.
//
// nu = T / kappa0 solves it, since nu kappa = P and nu K = nu; if all tours end, it is the only
// solution. So the states after those steps have that density, for any kappa0 and any step that
// leaves T unchanged, without start-up bias. The start itself must not be recorded.
//
// If r(x) tours start from a path in the mean, P becomes r P in all of this. With r in proportion
// to T / P all tours die at the same rate: energy redistribution path tracing (D. Cline, J. Talbot,
// P. Egbert, SIGGRAPH 2005).
#pragma once

#include <cstdint>

namespace mlt {

class KillRate {
 public:
  /// The rate of tours of which one starts from each path.
  explicit KillRate(double kappa0) : kappa0_(kappa0) {}
  /// The rate of tours of `steps` steps in the mean, at any state: kappa = 1 / steps.
  static KillRate constant(double kappa0, double steps) {
    KillRate rate(kappa0);
    rate.constant_ = 1 / steps;
    return rate;
  }

  /// r, the mean number of tours that start from a path with this T / P.
  double starts(double target_over_density) const {
    return constant_ > 0 ? constant_ * target_over_density / kappa0_ : 1;
  }
  /// 1 / (1 + kappa), the probability of surviving a state with this T / P.
  double survival(double target_over_density) const { return 1 / (1 + kappa(target_over_density)); }
  /// 1 / kappa, the mean number of steps that are left if all states have this T / P.
  double steps(double target_over_density) const { return 1 / kappa(target_over_density); }

 private:
  double kappa(double target_over_density) const {
    return constant_ > 0 ? constant_ : kappa0_ / target_over_density;
  }

  double kappa0_, constant_ = 0;
};

/// How far a tour has come: it dies as soon as the probability of having come so far is below one
/// uniform number.
struct Tour {
  double u;
  double left = 1;     ///< Probability of having survived all states but the current one.
  uint64_t steps = 0;  ///< Steps that it has made.
};

/// Makes steps until the tour dies, or must wait in a state from which it may not go on; returns
/// whether it is dead. `survival()` is that of the current state.
template <class GoesOn, class Survival, class Step>
bool run_tour(Tour& tour, GoesOn&& goes_on, Survival&& survival, Step&& step) {
  for (; goes_on(); ++tour.steps) {
    tour.left *= survival();
    if (!(tour.left > tour.u)) return true;
    step();
  }
  return false;
}

}  // namespace mlt
