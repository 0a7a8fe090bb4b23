// Independent samples and chains in one estimator. Both families find the same paths: N1 samples
// with the density P(x) of their techniques together, N2 states of chains with density T(x) / b. As
// with any multiple importance sampling (Veach 1997, eq. 9.4) a path is believed by shares that sum
// to one, whichever family has found it:
//
//   w1(x) = c / (c + T(x) / P(x)),   w2(x) = (T(x) / P(x)) / (c + T(x) / P(x))
//
// With c = b N1 / N2 this is the balance heuristic for N2 independent states. States of a chain are
// not, so that c is a larger number, which a pilot finds. T / P is high where the samples are noisy:
// there the chains are believed.
#pragma once

namespace mlt {

class FamilyWeights {
 public:
  /// Believes the chains alone.
  FamilyWeights() = default;
  /// `even` is c: a path with this T / P is believed half from each family.
  explicit FamilyWeights(double even) : even_(even) {}

  double of_sample(double target_over_density) const {
    return even_ / (even_ + target_over_density);
  }
  double of_chain(double target_over_density) const {
    return 1 / (1 + even_ / target_over_density);
  }

 private:
  double even_ = 0;
};

}  // namespace mlt
