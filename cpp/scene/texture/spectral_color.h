// The colours of a scene description, and what they are at the wavelengths of a path: the leaves
// that know whether a scene is spectral.
#pragma once

#include "math/curve.h"
#include "math/upsampling.h"
#include "math/wavelengths.h"

#include <memory>
#include <optional>

namespace mlt {

/// What an RGB colour stands for where there are wavelengths: a smooth reflectance that looks like
/// it under D65 (Jakob & Hanika 2019); the same for what has a unit, such as an extinction
/// coefficient; or light of that colour, D65 times a smooth reflectance.
enum class RgbMeaning { reflectance, coefficient, light };

/// A smooth spectrum: a reflectance times a scale, and D65 if it is light.
struct SmoothSpectrum {
  SmoothReflectance reflectance;
  double scale = 0;
  bool light = false;

  Spectrum at(double u) const;
};

/// The smooth spectrum of a colour at the wavelengths of u.
Spectrum upsampled(const Color& rgb, RgbMeaning meaning, double u);
/// The spectrum for paths of any scene: without wavelengths (u < 0), the colour itself.
inline Spectrum spectrum_of(const Color& rgb, RgbMeaning meaning, double u) {
  return u < 0 ? Spectrum(rgb) : upsampled(rgb, meaning, u);
}

/// Spectra that are linear in a colour, so that colours can be integrated first: at each wavelength
/// the weights of R, G and B sum to 1.
class LinearUpsampling {
 public:
  explicit LinearUpsampling(double u);
  Spectrum operator()(const Color& rgb) const {
    return rgb.x * red_ + rgb.y * green_ + rgb.z * blue_;
  }

 private:
  Spectrum red_, green_, blue_;
};

/// A colour that is the same everywhere: as RGB, and perhaps as a curve over the wavelengths.
class SpectralColor {
 public:
  SpectralColor() = default;
  SpectralColor(const Color& rgb, RgbMeaning meaning);
  /// `rgb` is what stands for the curve where there are no wavelengths.
  SpectralColor(const Color& rgb, Curve curve) : rgb_(rgb), curve_(std::move(curve)) {}

  Color rgb() const { return rgb_.rgb(); }
  Spectrum at(double u) const { return u < 0 ? rgb_ : at_wavelengths_of(u); }
  /// Whether it is the same at all wavelengths, in RGB too.
  bool grey() const { return is_grey(rgb_) && !curve_ && meaning_ != RgbMeaning::light; }

  SpectralColor over(double divisor) const;
  /// This colour, where RGB stands for something else.
  SpectralColor meaning(RgbMeaning meaning) const;

 private:
  Spectrum at_wavelengths_of(double u) const;

  Spectrum rgb_{0};
  RgbMeaning meaning_ = RgbMeaning::reflectance;
  SmoothSpectrum smooth_;
  std::shared_ptr<const wavelengths::Table> table_;  ///< The values of smooth_ in a table.
  std::optional<Curve> curve_;
};

}  // namespace mlt
