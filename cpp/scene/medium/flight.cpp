#include "scene/medium/flight.h"

namespace mlt {
namespace {

/// Optical depth; where there is no extinction it is 0 for an infinite distance, too.
Spectrum uniform_depth(const Spectrum& extinction, double distance) {
  Spectrum depth = extinction;
  for (int i = 0; i < Spectrum::lanes; ++i) depth[i] = depth[i] > 0 ? depth[i] * distance : 0;
  return depth;
}

}  // namespace

Flight uniform_flight(const Spectrum& sigma, const FlightLimit& limit) {
  const Spectrum depth = uniform_depth(sigma, limit.distance);
  if (!limit.ends(depth)) return {limit.distance, depth};
  double t = std::log(mean(limit.before) / limit.left) / max_component(sigma);
  for (int i = 0; !is_grey(sigma) && i < 100; ++i) {
    const Spectrum now = limit.before * exp(-sigma * t);
    const double step = (mean(now) - limit.left) / mean(sigma * now);
    t += step;
    if (!(step > 1e-14 * t)) break;
  }
  t = std::min(t, limit.distance);
  return {t, uniform_depth(sigma, t), true};
}

}  // namespace mlt
