// A function of the wavelength: what spectral scenes have in place of a colour or of a number.
#pragma once

#include "base/schema.h"
#include "math/color.h"

#include <memory>

namespace mlt {

/// Immutable, and cheap to copy. Wavelengths are in nm.
class Curve {
 public:
  static Curve constant(double value);
  /// Linear between the pairs and zero outside, as Mitsuba's `regular` and `irregular`. A single
  /// pair stands for all wavelengths; more are checked by check_spectrum.
  static Curve table(const WavelengthTable& samples);
  /// A curve of optical constants, which keep their end values outside.
  static Curve held_table(const WavelengthTable& samples);
  /// Planck's law, in W / (m^2 sr nm) as Mitsuba's `blackbody`. Throws UsageError unless the
  /// temperature is finite and positive.
  static Curve blackbody(double kelvin);
  /// CIE standard illuminant D65 with luminance 1 at visible wavelengths, zero at others.
  static Curve d65();

  Curve scaled(double factor) const;

  double at(double wavelength) const;
  /// The largest value at a visible wavelength.
  double maximum() const;

 private:
  struct Samples;

  static Curve of_samples(const WavelengthTable& samples, bool held);

  double scale_ = 1;
  double kelvin_ = 0;                       // of a black body
  std::shared_ptr<const Samples> samples_;  // of a table; neither: a constant
};

/// Light of this spectrum in linear sRGB, by the quadrature of spectrum_to_rgb but not clamped.
Color curve_to_rgb(const Curve& curve);

}  // namespace mlt
