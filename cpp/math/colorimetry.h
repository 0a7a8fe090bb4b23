// Spectra given as wavelength : value pairs, converted to linear sRGB by the rule of the RGB
// variants of Mitsuba 3, so that a scene has the same colours in both.
#pragma once

#include "base/schema.h"
#include "math/color.h"

namespace mlt {

/// The range of visible wavelengths, in nm.
inline constexpr double first_wavelength = 360, last_wavelength = 830;

/// The CIE 1931 2-degree colour-matching functions (x, y, z), linear between values every 5 nm, for
/// a wavelength in the visible range; the integral of y is 1.
Vec3 matching_functions(double wavelength);
/// CIE standard illuminant D65, likewise, so that its luminance is 1.
double d65(double wavelength);
/// X, Y and Z of f(nm), by Mitsuba's quadrature: 1000 points that include both ends, each worth
/// 470 nm / 1000.
template <class F>
Vec3 xyz_of(F&& f) {
  constexpr int points = 1000;
  constexpr double range = last_wavelength - first_wavelength;
  Vec3 xyz(0.0);
  for (int p = 0; p < points; ++p) {
    const double w = first_wavelength + p * (range / (points - 1));
    xyz += matching_functions(w) * f(w);
  }
  return xyz * (range / points);
}
/// XYZ to linear sRGB, with the digits that Mitsuba uses.
Color xyz_to_srgb(const Vec3& xyz);
Vec3 srgb_to_xyz(const Color& rgb);

/// The use of a spectrum, which decides its illuminant and range.
enum class SpectrumUse {
  reflectance,  // seen under D65, clamped to [0, 1]
  unbounded,    // seen under D65, clamped to >= 0: eta and k of a conductor
  emission,     // as it is, clamped to >= 0
};

/// Throws UsageError unless there are at least two pairs, in strictly increasing wavelength, all
/// finite.
void check_spectrum(const WavelengthTable& samples);

struct SpectrumColor {
  Color color;
  bool clamped;  // the colour was outside of the range, and was clamped
};

/// The pairs, which are checked, are interpolated linearly and are zero outside.
SpectrumColor spectrum_to_rgb(const WavelengthTable& samples, SpectrumUse use);

/// A spectrum with the same value everywhere: grey, except for an emitter, where it is the
/// equal-energy illuminant (slightly red beside the D65 white of sRGB).
Color uniform_spectrum_to_rgb(double value, SpectrumUse use);

}  // namespace mlt
