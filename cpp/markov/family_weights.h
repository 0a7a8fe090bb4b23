// Independent samples and chains in one estimator. Both families find the same paths: N1 samples
// with the density P(x) of their techniques together, N2 states of chains with density T(x) / b. As
// in any multiple importance sampling (Veach 1997, eq. 9.4) each path has two weights that sum to
// one, for the case that samples have found it and for the case that chains have:
//
//   w1(x) = c / (c + T(x) / P(x)),   w2(x) = (T(x) / P(x)) / (c + T(x) / P(x))
//
// With c = b N1 / N2 this is the balance heuristic for N2 independent states. States of a chain are
// not, so that c is a larger number, which a pilot finds. T / P is high where the samples are
// noisy: there the chains get the weight.
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
    return threshold / (threshold + target_over_density);
  }
  double of_chain(double target_over_density) const {
    return target_over_density > 0 ? 1 / (1 + threshold_ / target_over_density) : 0.0;
  }

 private:
  double threshold_ = 0;
};

}  // namespace mlt
