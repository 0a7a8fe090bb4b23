// Measured materials (Jensen, Marschner, Levoy & Hanrahan 2001, "A practical model for subsurface
// light transport", fig. 5), per millimetre. Names are those of Mitsuba.
#pragma once

#include "base/params.h"
#include "scene/medium/medium.h"

#include <string>
#include <vector>

namespace mlt {

struct MediumPreset {
  const char* name;
  Color scattering, absorption;  ///< sigma'_s and sigma_a
};

/// The material that the text parameter names. Throws SceneError.
const MediumPreset& medium_preset(Params& params, const std::string& parameter);
std::vector<std::string> medium_preset_names();

}  // namespace mlt
