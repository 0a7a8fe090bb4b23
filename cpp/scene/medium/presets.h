// Measured materials, per millimetre (Jensen, Marschner, Levoy & Hanrahan 2001, "A practical model
// for subsurface light transport", fig. 5; Narasimhan, Gupta, Donner, Ramamoorthi, Nayar & Jensen
// 2006, "Acquiring scattering properties of participating media by dilution", table 1). Names are
// those of Mitsuba, in lower case.
#pragma once

#include "base/params.h"
#include "scene/medium/medium.h"

#include <string>
#include <vector>

namespace mlt {

struct MediumPreset {
  const char* name;
  Color scattering, absorption;  ///< sigma_s, sigma_a
  Color g{0};                    ///< The mean cosine of the deflection.

  /// sigma'_s = (1 - g) sigma_s, with which scattering counts as isotropic.
  Color reduced_scattering() const { return scattering * (1.0 - g); }
};

/// The material that the text parameter names. Throws SceneError.
const MediumPreset& medium_preset(Params& params, const std::string& parameter);
std::vector<std::string> medium_preset_names();

}  // namespace mlt
