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
};

/// A flight that has ended.
struct Flight {
  double distance;
  Spectrum depth{0};   ///< tau, the integral of sigma_t up to there.
  bool stops = false;  ///< Whether it ends in the medium.
};

/// Where a flight ends, for an extinction that rises and falls: the root of
/// mean(before e^-tau(t)) = left between two distances, by Newton's method within a bracket.
/// depth(t) is tau, extinction(t) its derivative.
template <class Depth, class Extinction>
double flight_end(const FlightLimit& limit, double from, double to, Depth&& depth,
                  Extinction&& extinction) {
  double t = 0.5 * (from + to);
  for (int i = 0; i < 100 && from < to; ++i) {
    const Spectrum now = limit.before * exp(-depth(t));
    const double excess = mean(now) - limit.left;
    (excess > 0 ? from : to) = t;
    const double step = excess / mean(now * extinction(t)), next = t + step;
    if (std::fabs(step) <= 1e-15 * to) break;
    t = from < next && next < to ? next : 0.5 * (from + to);
  }
  return t;
}

/// A flight where the extinction is the same everywhere. In grey media it ends at
/// log(mean(before) / left) / sigma; in others Newton's method begins there, which is too short:
/// since the sum of exponentials is convex, it comes closer from there.
Flight uniform_flight(const Spectrum& extinction, const FlightLimit& limit);

}  // namespace mlt
