#include "scene/medium/flight.h"

namespace mlt {
namespace {

/// The flight in a grey medium.
Flight grey_flight(double sigma, const FlightLimit& limit) {
  const double depth = sigma > 0 ? sigma * limit.distance : 0;
  const double most = limit.grey_depth();
  if (!(most <= depth)) return {limit.distance, Spectrum(depth)};
  return {most / sigma, Spectrum(most), true};
}

/// Optical depth; where there is no extinction it is 0 for an infinite distance, too.
Spectrum uniform_depth(const Spectrum& extinction, double distance) {
  Spectrum depth = extinction;
  for (int i = 0; i < Spectrum::lanes; ++i) depth[i] = depth[i] > 0 ? depth[i] * distance : 0;
  return depth;
}

}  // namespace

Flight uniform_flight(const Spectrum& sigma, const FlightLimit& limit) {
  if (is_grey(sigma)) return grey_flight(sigma[0], limit);
  const Spectrum depth = uniform_depth(sigma, limit.distance);
  if (!limit.ends(depth)) return {limit.distance, depth};
  double t = 0;
  for (int i = 0; i < 100; ++i) {
    const Spectrum now = limit.before * exp(-sigma * t);
    const double step = std::log(mean(now) / limit.left) * mean(now) / mean(sigma * now);
    t += step;
    if (!(step > 1e-8 * t)) break;  // the rest is in proportion to the square
  }
  t = std::min(t, limit.distance);
  return {t, uniform_depth(sigma, t), true};
}

}  // namespace mlt
