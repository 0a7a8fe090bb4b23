#include "scene/medium/medium.h"

#include "base/magnitude.h"
#include "base/params.h"

namespace mlt {
namespace {

void pass(const Medium& medium, const Flight& flight, Passage& passed) {
  const Spectrum left = exp(-flight.depth);
  passed.transmittance *= left;
  if (medium.stops_walks()) passed.flight *= left;
}

}  // namespace

void check_extinction(const Params& params, double greatest) {
  if (too_large(greatest))
    params.fail(fmt::format("has an extinction of {:g}, but at most {:g} is right", greatest,
                            largest_magnitude));
}

void fly(const Medium& medium, const Ray& ray, double distance, Passage& passed) {
  pass(medium, medium.fly(ray, {distance}), passed);
}

std::optional<double> fly(const Medium& medium, const Ray& ray, double distance, double& u_leg,
                          Passage& passed) {
  const Spectrum before = passed.likelihood * passed.flight;
  const double left = medium.stops_walks() ? u_leg * mean(before) : 0;
  const Flight flight = medium.fly(ray, {distance, before, left});
  pass(medium, flight, passed);
  if (flight.stops) return flight.distance;
  if (left > 0) u_leg = left / mean(passed.likelihood * passed.flight);
  return std::nullopt;
}

}  // namespace mlt
