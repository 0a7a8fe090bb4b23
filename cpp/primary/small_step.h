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
  return rest < 1 ? rest : 0;  // what is just below 0 is rounded up to 1
}

struct SmallStep {
  enum class Shape {
    kelemen,  ///< Kelemen et al. 2002, sec. 4.2.
    gaussian
  };
  Shape shape = Shape::kelemen;
  double size = 1. / 32;  ///< The largest move, or the standard deviation.

  /// The smallest move over the largest one. Kelemen et al. move by 1/1024 to 1/64; twice that makes
  /// less noise in most scenes.
  static constexpr double smallest_share = 1. / 16;

  /// `count` steps in a row.
  double operator()(double u, uint64_t count, Rng& rng) const {
    if (shape == Shape::gaussian)
      return wrapped(u + size * std::sqrt(static_cast<double>(count)) * normal(rng));
    for (; count > 0; --count) u = wrapped(u + kelemen_move(rng));
    return u;
  }

 private:
  /// |s| lies between the smallest and the largest move, with a density proportional to 1 / |s|.
  double kelemen_move(Rng& rng) const {
    const double sample = rng.next();
    const bool up = sample < 0.5;
    const double move =
        size * std::exp(std::log(smallest_share) * (up ? 2 * sample : 2 * sample - 1));
    return up ? move : -move;
  }
  /// Of variance 1 (Box & Muller 1958).
  static double normal(Rng& rng) {
    const double radius = std::sqrt(-2 * std::log(1 - rng.next()));
    return radius * std::cos(2 * pi * rng.next());
  }
};

}  // namespace mlt
