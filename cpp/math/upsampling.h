// Reflectance spectra for RGB colours: W. Jakob and J. Hanika, "A Low-Dimensional Function Space
// for Efficient Spectral Upsampling", Computer Graphics Forum 38 (2), 2019.
// r(lambda) = 1/2 + v / (2 sqrt(1 + v^2)) with v = (c0 lambda + c1) lambda + c2 lies in (0, 1), and
// its colour under D65 is the given one. Beside the paper, fits are slightly regularised, the table
// holds scaled coefficients, which vary less, and the darkest colours have scaled spectra of
// brighter ones.
#pragma once

#include "math/color.h"

#include <vector>

namespace mlt {

struct SmoothReflectance {
  double c0 = 0, c1 = 0, c2 = 0;  // for wavelengths in nm
  double scale = 1;               // less for colours without a component above 0.02

  double at(double wavelength) const {
    const double v = (c0 * wavelength + c1) * wavelength + c2;
    return scale * (0.5 + 0.5 * v / std::sqrt(1 + v * v));
  }
};

/// The spectrum of a colour in linear sRGB, which is clamped to [0, 1]; of a grey it is flat.
SmoothReflectance fit_reflectance(const Color& rgb);

/// The coefficients of all colours, to be interpolated: for textures.
class ReflectanceTable {
 public:
  static constexpr size_t size = 32;  // along each axis

  /// Made by the first call, which takes a third of a second.
  static const ReflectanceTable& get();

  /// What fit_reflectance finds, but for interpolation: colours differ by less than 0.005.
  SmoothReflectance at(const Color& rgb) const;

 private:
  ReflectanceTable();
  void fill(size_t largest, size_t brightness);
  size_t index(size_t largest, size_t brightness, size_t i, size_t j) const {
    return ((largest * size + brightness) * size + i) * size + j;
  }

  std::vector<Vec3f> coefficients_;
};

}  // namespace mlt
