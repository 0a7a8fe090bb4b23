// The wavelengths that the lanes of a Spectrum stand for, and what a film records of them.
#pragma once

#include "math/spectrum.h"

namespace mlt {

/// Stands in place of a wavelength in an RGB scene: the lanes are R, G, B and G.
inline constexpr double rgb_lanes = -1;

/// In a spectral scene a path has a number u in [0, 1), and four wavelengths for it, which cover
/// the visible range evenly in the measure of u (Wilkie et al. 2014, "Hero wavelength spectral
/// sampling"): Lambda(frac(u + j / 4)). Lambda is linear between values of the inverse of
/// 1 / cosh^2, which is about proportional to what the eye sees (Radziszewski et al. 2009, "An
/// improved technique for full spectral rendering").
struct Wavelength {
  double nm;
  double per_u;  ///< d nm / d u: one over its density.
};
Wavelength wavelength_of(double u);
/// The u of the j-th lane.
inline double lane_of(double u, int j) {
  const double v = u + 0.25 * j;
  return v < 1 ? v : v - 1;
}

/// The values f(nm) at the wavelengths of u.
template <class F>
Spectrum at_wavelengths(double u, F&& f) {
  Spectrum s;
  for (int j = 0; j < Spectrum::lanes; ++j) s[j] = f(wavelength_of(lane_of(u, j)).nm);
  return s;
}

/// What a film records of the light of a path: in an RGB scene its colour; in a spectral one its
/// X, Y and Z over those of D65, which cannot be negative as the colour of one wavelength can.
///
/// Refraction that depends on the wavelength, anywhere on the path, sends the other wavelengths
/// elsewhere: then the first lane alone counts, four times. Both have the same mean over u.
Color recorded_spectrum(const Spectrum& light, double u, bool dispersed);
inline Color recorded(const Spectrum& light, double u, bool dispersed = false) {
  return u < 0 ? light.rgb() : recorded_spectrum(light, u, dispersed);
}
inline Spectrum first_lane(const Spectrum& s) { return {s[0], 0, 0, 0}; }
/// The linear sRGB of such X, Y and Z.
Color developed(const Color& recorded);

}  // namespace mlt
