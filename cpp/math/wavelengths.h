// The wavelengths that the lanes of a Spectrum stand for, and what a film records of them.
#pragma once

#include "math/spectrum.h"

#include <array>

namespace mlt {

/// Stands in place of a wavelength in an RGB scene: the lanes are R, G, B and G.
inline constexpr double rgb_lanes = -1;

/// An interval of wavelengths in nm, of which a film may record the mean.
struct Band {
  double first, last;
};

/// In a spectral scene a path has a number u in [0, 1), and four wavelengths for it, which cover
/// the visible range evenly in the measure of u (Wilkie et al. 2014, "Hero wavelength spectral
/// sampling"): Lambda(frac(u + j / 4)). Lambda is linear between values of the inverse of
/// 1 / cosh^2, which is about proportional to what the eye sees (Radziszewski et al. 2009, "An
/// improved technique for full spectral rendering").
///
/// Where a film records a band, a path has one wavelength, in all lanes, and its nm stand in place
/// of u: they cannot be taken for it.
namespace wavelengths {

inline constexpr int cells = 512;
/// A function of u at the borders of cells.
using Table = std::array<double, cells + 1>;

struct Tables {
  Table nm, d65;
  /// What a film records of one lane: X, Y and Z over those of D65, over the density of u.
  std::array<Color, cells + 1> response;

  Tables();
};
extern const Tables tables;

/// A place in the tables, and that of a lane whose u is frac(u + j / 4).
struct Place {
  int cell;
  double within;

  explicit Place(double u) : cell(std::min(static_cast<int>(u * cells), cells - 1)) {
    within = u * cells - cell;
  }
  template <class T>
  T at(const std::array<T, cells + 1>& table, int lane) const {
    const int i = (cell + lane * (cells / Spectrum::lanes)) % cells;
    return table[i] + within * (table[i + 1] - table[i]);
  }
};

/// The values at the four wavelengths of u.
inline Spectrum look_up(const Table& table, double u) {
  const Place place(u);
  Spectrum s;
  for (int j = 0; j < Spectrum::lanes; ++j) s[j] = place.at(table, j);
  return s;
}

}  // namespace wavelengths

/// Whether u is the only wavelength of a path, in nm.
inline bool is_single(double u) { return u >= 1; }

/// Lambda(u), in nm.
inline double wavelength_of(double u) {
  return is_single(u) ? u : wavelengths::Place(u).at(wavelengths::tables.nm, 0);
}

/// The values f(nm) at the four wavelengths of u, or at the single one.
template <class F>
Spectrum at_wavelengths(double u, F&& f) {
  if (is_single(u)) return Spectrum(f(u));
  return lane_by_lane(wavelengths::look_up(wavelengths::tables.nm, u), f);
}

/// The daylight d65(nm) of math/colorimetry.h at the wavelengths of u.
Spectrum daylight(double u);

/// What a film records of the light of a path: in an RGB scene its colour; in a spectral one its
/// X, Y and Z over those of D65, which cannot be negative as the colour of one wavelength can, or
/// the radiance at a single wavelength.
///
/// Refraction that depends on the wavelength, anywhere on the path, sends the other wavelengths
/// elsewhere: then the first lane alone counts, four times. Both have the same mean over u.
Color recorded_spectrum(const Spectrum& light, double u, bool dispersed);
inline Color recorded(const Spectrum& light, double u, bool dispersed = false) {
  return u < 0 ? light.rgb() : recorded_spectrum(light, u, dispersed);
}
inline Spectrum first_lane(const Spectrum& s) { return {s[0], 0, 0, 0}; }
/// The linear sRGB of X, Y and Z as recorded_spectrum() has them, and back.
Color developed(const Color& recorded);
Color undeveloped(const Color& rgb);

}  // namespace mlt
