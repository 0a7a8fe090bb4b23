// Clear daylight: the sky of Hosek & Wilkie 2012, "An analytic model for full spectral sky-dome
// radiance", in its version for RGB, and the sun of Preetham, Shirley & Smits 1999, "A practical
// analytic model for daylight", appendix. Radiances are in the units of Mitsuba 0.6.
#pragma once

#include "math/spectrum.h"

#include <array>

namespace mlt {

class SkyModel {
 public:
  /// The turbidity lies in [1, 10], the ground's albedo in [0, 1], the sun's elevation above the
  /// horizon in [0, pi/2].
  SkyModel(double turbidity, const Color& albedo, double elevation);

  /// Radiance from above the horizon, by the cosine with the zenith and the angle to the sun.
  Color radiance(double cos_theta, double gamma) const;

 private:
  using Coefficients = std::array<double, 10>;  ///< The mean radiance, then A to I.
  std::array<Coefficients, 3> channels_;
};

/// Radiance of the sun's disk at this angle from the zenith.
Color sun_radiance(double theta, double turbidity);

/// Angular radius of the sun's disk: half of 0.5358 degrees.
constexpr double sun_radius = 0.5 * 0.5358 * 3.14159265358979323846 / 180;

}  // namespace mlt
