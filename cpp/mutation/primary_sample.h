// Primary-sample-space mutations (Kelemen, Szirmay-Kalos, Antal & Csonka 2002, "A simple and robust
// mutation strategy for the Metropolis light transport algorithm"). The state is the vector of
// uniform numbers that a path was made from; the target is what the path estimator returns for it.
//
// A walk uses as many numbers as it needs. Numbers that the current path does not use are, given
// the path, uniform and independent: drawing them afresh when a proposal needs them leaves the
// distribution unchanged, so only used numbers are kept.
#pragma once

#include "base/rng.h"
#include "markov/step.h"
#include "math/color.h"
#include "math/vec.h"

#include <cmath>
#include <vector>

namespace mlt {

struct PrimaryState {
  std::vector<double> numbers;
  Vec2 raster{0};
  Color rgb{0};       ///< The estimator's value f / p.
  double target = 0;  ///< L* of it; NaN if the estimator failed.
};

/// T / P, where independent samples have the density 1.
inline double target_over_density(const PrimaryState& x) { return x.target; }

/// A small step: u + s, wrapped around, where |s| is distributed between 1/1024 and 1/64 with
/// density proportional to 1/|s| (Kelemen et al. 2002, sec. 4.2). Symmetric.
inline double small_step(double u, Rng& rng) {
  constexpr double smallest = 1.0 / 1024, largest = 1.0 / 64;
  const double sample = rng.next();
  const bool up = sample < 0.5;
  const double size =
      largest * std::exp(-std::log(largest / smallest) * (up ? 2 * sample : 2 * sample - 1));
  const double moved = up ? u + size : u - size;
  const double wrapped = moved - std::floor(moved);
  return wrapped < 1 ? wrapped : 0;  // a moved one just below 0 is rounded up to 1
}

/// Large steps draw all numbers afresh, small steps move each a little. Both are symmetric, so the
/// quotients of the step are the targets alone. `evaluate(state, rng)` walks: it fills in raster,
/// rgb and target, and trims the numbers to those used.
template <class Evaluate>
class PrimarySampleKernel {
 public:
  using State = PrimaryState;
  enum Move { large = 0, small = 1 };

  PrimarySampleKernel(double large_probability, Evaluate evaluate)
      : large_probability_(large_probability), evaluate_(std::move(evaluate)) {}

  Transition propose(const PrimaryState& x, std::array<PrimaryState, 1>& proposals, size_t,
                     Rng& rng) {
    PrimaryState& y = proposals[0];
    last_ = rng.next() < large_probability_ ? large : small;
    y.numbers.clear();
    if (last_ == small)
      for (const double u : x.numbers) y.numbers.push_back(small_step(u, rng));
    evaluate_(y, rng);
    if (!generated(y)) return impossible;
    return {1 / y.target, 1 / x.target};
  }

  Move last() const { return last_; }
  static bool generated(const PrimaryState& y) { return y.target != 0; }
  Evaluate& evaluate() { return evaluate_; }

 private:
  double large_probability_;
  Evaluate evaluate_;
  Move last_ = large;
};

}  // namespace mlt
