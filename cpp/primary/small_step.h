// Small steps of one uniform number, on the circle that [0, 1) becomes when its ends are joined.
// All are symmetric.
#pragma once

#include "base/rng.h"
#include "math/vec.h"

#include <cmath>

namespace mlt {

/// Wraps u around, into [0, 1).
inline double wrapped(double u) {
  const double rest = u - std::floor(u);
  return rest < 1 ? rest : 0;  // numbers just below 0 are rounded up to 1
}

struct SmallStep {
  enum class Shape {
    kelemen,  ///< Kelemen et al. 2002, sec. 4.2.
    gaussian
  };
  Shape shape = Shape::kelemen;
  double size = 1. / 32;  ///< The largest move, or the standard deviation.

  /// The smallest move over the largest one. Kelemen et al. move by 1/1024 to 1/64; twice that
  /// makes less noise in most scenes.
  static constexpr double smallest_share = 1. / 16;

  double operator()(double u, Rng& rng) const {
    const double sample = rng.next();
    return shape == Shape::gaussian ? gaussian(u, sample, rng.next()) : kelemen(u, sample);
  }

  /// One step by the random number `sample`; |s| lies between the smallest and the largest move,
  /// with a density proportional to 1 / |s|. Without branches, for many numbers side by side.
  double kelemen(double u, double sample) const {
    const bool up = sample < 0.5;
    const double move = size * power_of_smallest_share(up ? 2 * sample : 2 * sample - 1);
    return wrapped(u + (up ? move : -move));
  }
  /// One Gaussian step by two random numbers (Box & Muller 1958).
  double gaussian(double u, double sample, double angle) const {
    const double radius = std::sqrt(-2 * std::log(1 - sample));
    return wrapped(u + size * radius * std::cos(2 * pi * angle));
  }

 private:
  /// smallest_share^t, t in [0, 1), to 1e-13: the Taylor series of its 16th root.
  static double power_of_smallest_share(double t) {
    const double x = std::log(smallest_share) / 16 * t;
    const double root =
        1 +
        x * (1 +
             x * (1. / 2 +
                  x * (1. / 6 +
                       x * (1. / 24 +
                            x * (1. / 120 +
                                 x * (1. / 720 +
                                      x * (1. / 5040 + x * (1. / 40320 + x * (1. / 362880)))))))));
    return sqr(sqr(sqr(sqr(root))));
  }
};

/// Leaves a number as it is.
inline constexpr SmallStep no_step{SmallStep::Shape::kelemen, 0};

}  // namespace mlt
