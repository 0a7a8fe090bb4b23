// The terms of one scattering event at a surface.
#pragma once

#include "math/spectrum.h"

#include <cstdint>

namespace mlt {

/// The kind of scattering at a path vertex: by a density over directions, or by one of the delta
/// distributions.
enum class Lobe : uint8_t {
  smooth,       ///< All non-delta lobes, summed.
  reflection,   ///< Perfect mirror reflection.
  transmission  ///< Perfect refraction.
};

/// smooth: `f` is the BSDF for radiance that flows from wl to wc (without a cosine; for refraction
/// it includes the factor (eta_c / eta_l)^2 of radiance, Veach 1997, eq. 5.12), the densities are
/// in solid angle.
/// delta: `f` is the fraction F of power that this lobe carries (without the eta^2 of radiance: see
/// `relative_eta`), the densities are the discrete probabilities of choosing this delta.
struct Scattering {
  Spectrum f{0};
  double pdf_from_light = 0;   ///< Density of wc, given wl.
  double pdf_from_camera = 0;  ///< Density of wl, given wc.
  /// Whether the directions depend on the wavelength: f has the first lane alone.
  bool disperses = false;
};

}  // namespace mlt
