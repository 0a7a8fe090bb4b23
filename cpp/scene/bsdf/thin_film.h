// A film on a surface, thin enough that light that it reflects from above and below interferes: the
// reflectance by Airy's sum (Born & Wolf, "Principles of Optics", 7th ed., sec. 7.6.1), at the
// wavelengths of a path, or its mean over what R, G and B see (Belcour & Barla 2017, "A practical
// extension to microfacet theory for the modeling of varying iridescence").
#pragma once

#include "math/number.h"
#include "math/spectrum.h"

#include <array>

namespace mlt {

class ThinFilm {
 public:
  /// A film of `nanometres` with the index `film`, on a dielectric with the index `base`; both are
  /// relative to the outside.
  ThinFilm(double nanometres, double film, double base);

  /// The reflectance for light from above with this cosine, and its complement below.
  Spectrum dielectric(double cosine, double wavelength) const;
  /// Its mean for diffuse light.
  Spectrum mean(double wavelength) const;
  /// That of a film on a metal, which has the reflectance `bare` for such light without the film:
  /// it is taken for that of a real amplitude, which the film's index changes below the film.
  Spectrum metal(double cosine, double wavelength, const Spectrum& bare) const;

 private:
  static constexpr int cosines = 64, levels = 16;

  /// The cosine inside of the film.
  double cosine_inside(double cosine) const;
  /// Twice the optical path through the film, in radians at 1 nm.
  double path(double cosine) const;
  double dielectric_at(double cosine, double nm) const;
  double metal_at(double cosine, double nm, double bare) const;

  double nanometres_, film_, base_;
  std::array<Color, cosines> dielectric_;                 ///< In RGB.
  std::array<std::array<Color, levels>, cosines> metal_;  ///< Likewise, by sqrt(bare).
};

}  // namespace mlt
