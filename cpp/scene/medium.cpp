#include "scene/medium.h"

namespace mlt {

void fly(const Medium& medium, const Ray& ray, double distance, Passage& passed) {
  const Color left = exp(-medium.optical_depth(ray, distance));
  passed.transmittance *= left;
  if (medium.scatters()) passed.flight *= left;
}

std::optional<double> fly(const Medium& medium, const Ray& ray, double distance, double& u_leg,
                          Passage& passed) {
  const Color before = passed.flight;
  Passage beyond = passed;
  fly(medium, ray, distance, beyond);
  const double left = u_leg * mean(before), least = mean(beyond.flight);
  if (left < least || u_leg == 0) {
    if (left > 0) u_leg = left / least;
    passed = beyond;
    return std::nullopt;
  }
  const double stop = std::min(medium.flight_distance(ray, before, left), distance);
  fly(medium, ray, stop, passed);
  return stop;
}

}  // namespace mlt
