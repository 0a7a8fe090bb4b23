// Indices of refraction among the parameters of a material.
#pragma once

#include "base/params.h"
#include "math/fresnel.h"
#include "scene/spectral_color.h"

namespace mlt {

/// The parameters `int_ior` and `ext_ior`, with the given default inside and air outside.
std::vector<Parameter> ior_parameters(const std::string& default_inside);
/// The relative index int_ior / ext_ior.
double relative_ior_param(Params& params);

/// The parameters `specular_reflectance` and `specular_transmittance` of an interface.
std::vector<Parameter> interface_factors();

/// The parameters `material`, `eta`, `k`, `ext_eta` and `specular_reflectance` of a conductor.
std::vector<Parameter> conductor_parameters();
/// A complex index, relative to the outside.
struct ConductorIor {
  SpectralColor eta, k;

  Spectrum fresnel(double cosine, double wavelength) const {
    return fresnel_conductor(cosine, eta.at(wavelength), k.at(wavelength));
  }
};
/// That by the parameters of a conductor.
ConductorIor conductor_param(Params& params);

}  // namespace mlt
