// Indices of refraction among the parameters of a material.
#pragma once

#include "base/params.h"
#include "math/dispersion.h"
#include "math/fresnel.h"
#include "scene/texture/spectral_color.h"

namespace mlt {

/// The parameters `int_ior` and `ext_ior`, of which RefractiveIndex tells the forms, with the given
/// default inside and air outside.
std::vector<Parameter> ior_parameters(const std::string& default_inside);
/// The relative index int_ior / ext_ior where there are no wavelengths.
double relative_ior_param(Params& params);

/// An index, and what it is where there are no wavelengths.
struct SideIndex {
  RefractiveIndex curve;
  double in_rgb;
};

/// An index that differs from this one by so little that nearly nothing is reflected between them.
inline SideIndex barely_denser(const SideIndex& index) {
  const double n = 1.0001 * index.in_rgb;
  return {RefractiveIndex::constant(n), n};
}

/// A relative index that may depend on the wavelength.
struct RelativeIndex {
  SideIndex inside, outside;

  /// Where there are no wavelengths.
  double in_rgb() const { return inside.in_rgb / outside.in_rgb; }
  bool disperses() const { return inside.curve.disperses() || outside.curve.disperses(); }
  double at_nm(double nm) const { return inside.curve.at(nm) / outside.curve.at(nm); }
};
/// That of int_ior and ext_ior. A default does not disperse.
RelativeIndex relative_index_param(Params& params);

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
