#include "scene/bsdf/ior_params.h"

#include "math/ior.h"
#include "math/ior_curves.h"
#include "scene/texture.h"

namespace mlt {
namespace {

double ior_param(Params& params, const std::string& name) {
  const Value& value = params.value(name);
  if (const std::string* material = std::get_if<std::string>(&value)) {
    if (const auto ior = find_dielectric(*material)) return *ior;
    params.fail(name, "names no known material: '" + *material + "'" +
                          suggestion(*material, dielectric_names()));
  }
  const double ior = params.real(name);
  if (!(ior > 0)) params.fail(name, "must be positive");
  return ior;
}

/// A component of a complex index: a number, an RGB triple or a spectrum. The colour of a metal
/// that is out of gamut may be negative; Mitsuba 3 has only its square in the Fresnel equations.
SpectralColor index_param(Params& params, const std::string& name) {
  const SpectralColor color = to_spectral(params, name, SpectrumUse::unbounded);
  if (min_component(color.rgb()) >= 0) return color;
  params.warn("'" + name + "' is negative; it is taken without its sign, as in Mitsuba 3");
  return {glm::abs(color.rgb()), RgbMeaning::coefficient};
}

}  // namespace

std::vector<Parameter> ior_parameters(const std::string& default_inside) {
  return {
      {"int_ior", ParamType::ior, default_inside,
       "Index of refraction inside (below the surface): a number or a material's name."},
      {"ext_ior", ParamType::ior, std::string("air"),
       "Index of refraction outside (where the normal points): a number or a material's name."}};
}

std::vector<Parameter> interface_factors() {
  return {{"specular_reflectance", ParamType::texture, 1.0, "Factor on the reflection."},
          {"specular_transmittance", ParamType::texture, 1.0, "Factor on the refraction."}};
}

double relative_ior_param(Params& params) {
  const double inside = ior_param(params, "int_ior");
  return inside / ior_param(params, "ext_ior");
}

std::vector<Parameter> conductor_parameters() {
  return {
      {"material", ParamType::text, std::string("none"),
       "Chemical symbol of a metal, such as Au or Cu; none is a perfect mirror unless eta and k "
       "are given.",
       conductor_names()},
      {"eta", ParamType::radiance, 0.0, "Real part of the index of refraction."},
      {"k", ParamType::radiance, 1.0, "Imaginary part of the index of refraction."},
      {"ext_eta", ParamType::ior, 1.0,
       "Index of refraction outside: a number or a material's name."},
      {"specular_reflectance", ParamType::texture, 1.0, "Factor on the reflection."}};
}

ConductorIor conductor_param(Params& params) {
  const std::string material = params.text("material");
  const double outside = ior_param(params, "ext_eta");
  if (material == "none")
    return {index_param(params, "eta").over(outside), index_param(params, "k").over(outside)};
  for (const char* name : {"eta", "k"})
    if (params.has(name)) params.fail(name, "cannot be given together with a material");
  const ComplexIor rgb = find_conductor(material).value();
  const ConductorCurves curves = find_conductor_curves(material).value();
  return {SpectralColor(rgb.eta, curves.eta).over(outside),
          SpectralColor(rgb.k, curves.k).over(outside)};
}

}  // namespace mlt
