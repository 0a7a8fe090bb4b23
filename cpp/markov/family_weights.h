// Independent samples and chains in one estimator. Both families find the same paths: N1 samples
// with the density P(x) of their techniques together, N2 states of chains with density T(x) / b. As
// in any multiple importance sampling (Veach 1997, eq. 9.4) each path has two weights that sum to
// one, for the case that samples have found it and for the case that chains have:
//
//   w1(x) = c^2 / (c^2 + (T(x) / P(x))^2),   w2(x) = 1 - w1(x)
//
// With c = b N1 / N2 this is the power heuristic (sec. 9.2.3) for N2 independent states. States of
// a chain are not, so that c is a larger number, which a pilot finds. T / P is high where the
// samples are noisy: there the chains get the weight, and hardly any elsewhere.
#pragma once

namespace mlt {

class FamilyWeights {
 public:
  /// The weights of chains alone.
  FamilyWeights() = default;
  /// `threshold` is c: both weights of a path with this T / P are one half.
  explicit FamilyWeights(double threshold) : threshold_(threshold) {}

  double threshold() const { return threshold_; }

  double of_sample(double target_over_density) const {
    return of_sample(target_over_density, threshold_);
  }
  static double of_sample(double target_over_density, double threshold) {
    return power_weight(threshold, target_over_density);
  }
  double of_chain(double target_over_density) const {
    return target_over_density > 0 ? power_weight(target_over_density, threshold_) : 0.0;
  }

 private:
  static double power_weight(double own, double other) {
    const double ratio = other / own;
    return 1 / (1 + ratio * ratio);
  }

  double threshold_ = 0;
};

}  // namespace mlt
