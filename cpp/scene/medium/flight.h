// The flight of light along a ray through a medium.
#pragma once

#include "math/spectrum.h"
#include "scene/ray.h"

#include <cmath>

namespace mlt {

/// Where a flight ends: at a distance from the start of the ray's edge, which may be infinite, or
/// where the mean over the channels of before e^-tau has fallen to `left`.
struct FlightLimit {
  double distance;
  Spectrum before{1};
  double left = 0;

  /// Whether the flight ends where the optical depth is tau.
  bool ends(const Spectrum& tau) const { return left > 0 && mean(before * exp(-tau)) <= left; }
  /// The optical depth where it ends, if that is the same in all channels.
  double grey_depth() const { return left > 0 ? std::log(mean(before) / left) : infinity; }
};

/// A flight that has ended.
struct Flight {
  double distance;
  Spectrum depth{0};   ///< tau, the integral of sigma_t up to there.
  bool stops = false;  ///< Whether it ends in the medium.
};

/// The root between two distances of a function that falls, by Newton's method within a bracket;
/// f(t) is its value and its slope, less its sign.
template <class F>
double flight_end(double from, double to, F&& f) {
  double t = 0.5 * (from + to);
  for (int i = 0; i < 100 && from < to; ++i) {
    const auto [excess, fall] = f(t);
    (excess > 0 ? from : to) = t;
    const double step = excess / fall, next = t + step;
    if (std::fabs(step) <= 1e-15 * to) break;
    t = from < next && next < to ? next : 0.5 * (from + to);
  }
  return t;
}

/// A flight where the extinction is the same everywhere. In media that are not grey Newton's method
/// finds the root of log(mean(before e^-sigma t) / left), from 0 on: since the logarithm of a sum
/// of exponentials is convex and nearly straight, it comes closer from below in few steps.
Flight uniform_flight(const Spectrum& extinction, const FlightLimit& limit);

}  // namespace mlt
