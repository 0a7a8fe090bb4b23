// Independent samples and chains in one estimator. Both find the same paths, samples with
// the density P(x) of their techniques together. As in any multiple importance sampling (Veach
// 1997, eq. 9.4) each path has two weights that sum to one, for the case that a sample has found it
// and for the case that a chain has. With the target T and tau(x) = T(x) / P(x), the brightness of
// a path that a sample has found:
//
//   w1(x) = min(1, c / tau(x)),   w2(x) = 1 - w1(x) = max(0, 1 - c / tau(x))
//
// Samples are clamped: one that is brighter than c counts as c. Chains show what that cuts off.
//
// Chains that take this as their target, as those of mlt do, have
//
//   T'(x) = T(x) w2(x) = max(0, T(x) - c P(x))
//
// and record f w2 / T' = f / T: all their steps are equally bright, and none is spent on light that
// samples show. That is the balance heuristic (Veach 1997, sec. 9.2.2) between samples and states
// of such chains: the density of these, times the number r of steps per sample, is r T' / e, with e
// the integral of T', so that it gives samples the weight
//
//   P / (P + r T' / e) = 1 / (1 + (tau - c) / c) = c / tau   with c = e / r.
//
// Clamping in this way was found by the density of a path's neighbourhood before (B. Bitterli, W.
// Jarosz, "Selectively metropolised Monte Carlo light transport simulation", SIGGRAPH Asia 2019).
#pragma once

namespace mlt {

class ClampingWeights {
 public:
  /// The weights of chains alone: c = 0.
  ClampingWeights() = default;
  /// `threshold` is c.
  explicit ClampingWeights(double threshold) : threshold_(threshold) {}

  double threshold() const { return threshold_; }

  /// w1.
  double of_sample(double target_over_density) const {
    return of_sample(target_over_density, threshold_);
  }
  static double of_sample(double target_over_density, double threshold) {
    return target_over_density > threshold ? threshold / target_over_density : 1.0;
  }
  /// w2.
  double of_chain(double target_over_density) const { return 1 - of_sample(target_over_density); }

 private:
  double threshold_ = 0;
};

}  // namespace mlt
