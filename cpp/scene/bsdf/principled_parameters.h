// The parameters of Mitsuba 3's principled material.
#pragma once

#include "base/params.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mlt {

inline std::vector<Parameter> principled_parameters() {
  return {
      {"base_color", ParamType::texture, 0.5, "Colour of the material."},
      {"roughness", ParamType::texture, 0.5, "Roughness of the main lobe; alpha is its square."},
      {"anisotropic", ParamType::texture, 0.0, "How much the main lobe is stretched along u."},
      {"metallic", ParamType::texture, 0.0, "Between a dielectric (0) and a metal (1)."},
      {"spec_trans", ParamType::texture, 0.0, "Between an opaque (0) and a clear dielectric (1)."},
      {"eta", ParamType::real, no_default, "Index of refraction inside over outside; or specular."},
      {"specular", ParamType::real, 0.5,
       "Reflectance of the dielectric at normal incidence / 0.08."},
      {"spec_tint", ParamType::texture, 0.0, "How much the base tints the dielectric reflection."},
      {"sheen", ParamType::texture, 0.0, "Of a layer that brightens grazing angles, as on cloth."},
      {"sheen_tint", ParamType::texture, 0.0, "How much the base tints the sheen."},
      {"flatness", ParamType::texture, 0.0, "Between diffuse (0) and subsurface-like (1)."},
      {"clearcoat", ParamType::texture, 0.0, "Of a second, isotropic lobe above everything."},
      {"clearcoat_gloss", ParamType::texture, 0.0, "Of the clear coat: 1 is sharpest."},
      {"diffuse_reflectance_sampling_rate", ParamType::real, 1.0, "How often it is sampled."},
      {"main_specular_sampling_rate", ParamType::real, 1.0, "How often it is sampled."},
      {"clearcoat_sampling_rate", ParamType::real, 1.0, "How often it is sampled."}};
}

/// The index of refraction inside over outside, by `eta` or by `specular`.
inline double principled_eta(Params& params, bool refracts) {
  if (params.has("eta") && params.has("specular"))
    params.fail("eta", "and 'specular' exclude each other");
  double eta;
  if (params.has("eta")) {
    eta = params.real_in("eta", 1e-3, 1e3);
  } else {
    // Burley 2015, sec. 3: R0 = 0.08 specular.
    const double least = refracts ? 1e-3 : 0;
    const double r = std::sqrt(0.08 * std::max(params.real_in("specular", 0, 1), least));
    eta = 2 / (1 - r) - 1;
  }
  return refracts && eta == 1 ? 1.001 : eta;
}

}  // namespace mlt
