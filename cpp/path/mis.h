// Multiple importance sampling over the techniques that can make a path (Veach 1997, ch. 9 and
// sec. 10.2). Waves find their weights by the same MisExponent (wave/joint_lanes.h,
// wave/lambertian_vertices.h).
#pragma once

#include "math/vec.h"

#include <algorithm>

namespace mlt {

enum class Heuristic { balance, power, maximum };

/// The weight of a technique that counts `own` times beside the others, which count these sums of
/// r_i^beta: those below it, and those above it (Veach 1997, eq. 9.8, and 9.13 with beta = 2).
inline double mis_weight(double own, double below, double above = 0) {
  return own / (own + below + above);
}

/// The beta of the heuristic to which quotients of densities are raised: 1 for the balance
/// heuristic, 2 for the power heuristic. Without a branch: by a factor of 1 or of the quotient.
class MisExponent {
 public:
  explicit MisExponent(Heuristic heuristic) {
    if (heuristic == Heuristic::balance) least_ = most_ = 1;
  }
  template <class F>
  F raise(F quotient) const {
    return quotient * std::min(std::max(quotient, F(least_)), F(most_));
  }
  /// The sum of r_i^beta (see TechniqueSums) after the connection has moved over one vertex, into
  /// the path.
  template <class F>
  F over(F sum, F quotient) const {
    return sum * raise(quotient);
  }
  /// The weight of one of two techniques by their densities.
  double weight(double own, double other) const { return mis_weight(1, raise(other / own)); }
  /// The weight of one of three.
  double weight(double own, double second, double third) const {
    return mis_weight(1, raise(second / own), raise(third / own));
  }

 private:
  double least_ = 0, most_ = infinity;
};

/// The weights of one technique: by the chosen heuristic, and by the balance heuristic, which is
/// p_s / P.
struct MisWeights {
  double chosen = 0, balance = 0;
};

/// The quotients r_i = p_i / p_s of the techniques on one side of s: their sum, that of their
/// squares, and the largest. By the recurrence of Veach 1997, eq. 10.9,
///
///   p_{i+1} / p_i = from_light / from_camera of x_i,
///
/// all of them are multiplied by one factor when the joint moves over a vertex. So the sums grow
/// from the end of a path inwards, and the part of them that lies within a subpath is the same for
/// all its connections (van Antwerpen 2011, "Recursive MIS computation for streaming BDPT on the
/// GPU"; Georgiev 2012, "Implementing vertex connection and merging").
struct TechniqueSums {
  double sum = 0, squares = 0, largest = 0;

  /// The sums with one more technique, which counts `technique` times: 1; 0 if it cannot make the
  /// path; direct / from_light of x_0 for s = 1.
  TechniqueSums with(double technique) const {
    return {technique + sum, sqr(technique) + squares, std::max(technique, largest)};
  }
  TechniqueSums with(const TechniqueSums& others) const {
    return {others.sum + sum, others.squares + squares, std::max(others.largest, largest)};
  }
  /// The sums after the joint has moved inwards over a vertex, which divides p_s, and so
  /// multiplies all r_i by `quotient`.
  TechniqueSums over(double quotient) const {
    if (!(quotient > 0) || sum == 0) return {};  // 0 stays 0, also where the quotient is infinite.
    return {quotient * sum, squares > 0 ? sqr(quotient) * squares : 0, quotient * largest};
  }
};

/// The weights of technique s, which counts `own` times, from the sums over the techniques below s
/// and above it. For the maximum heuristic see Veach 1997, eq. 9.12.
inline MisWeights mis_weights(double own, const TechniqueSums& below, const TechniqueSums& above,
                              Heuristic heuristic) {
  const double balance = mis_weight(own, below.sum, above.sum);
  switch (heuristic) {
    case Heuristic::balance: break;
    case Heuristic::power: return {mis_weight(sqr(own), below.squares, above.squares), balance};
    case Heuristic::maximum:  // the first of equal techniques
      return {below.largest < own && above.largest <= own ? 1.0 : 0.0, balance};
  }
  return {balance, balance};
}

}  // namespace mlt
