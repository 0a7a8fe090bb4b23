#include "scene/bsdf/ior_params.h"

#include "math/spectrum.h"

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

Color spectrum_index(Params& params, const std::string& name, const Spectrum& spectrum) {
  if (spectrum.size() == 1)
    return uniform_spectrum_to_rgb(spectrum[0].second, SpectrumUse::unbounded);
  std::vector<SpectrumSample> samples;
  for (const auto& [wavelength, value] : spectrum) samples.push_back({wavelength, value});
  try {
    return spectrum_to_rgb(samples, SpectrumUse::unbounded).color;
  } catch (const UsageError& error) {
    params.fail(name, std::string("is no valid spectrum: ") + error.what());
  }
}

/// A component of a complex index: a number, an RGB triple or a spectrum, none negative.
Color index_param(Params& params, const std::string& name) {
  const Value& value = params.value(name);
  Color color(0);
  if (const Triple* rgb = std::get_if<Triple>(&value)) {
    color = {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
  } else if (const Spectrum* spectrum = std::get_if<Spectrum>(&value)) {
    color = spectrum_index(params, name, *spectrum);
  } else {
    color = Color(params.real(name));
  }
  if (!(min_component(color) >= 0)) params.fail(name, "must not be negative");
  return color;
}

}  // namespace

std::vector<Parameter> ior_parameters(const std::string& default_inside) {
  return {
      {"int_ior", ParamType::ior, default_inside,
       "Index of refraction inside (below the surface): a number or a material's name."},
      {"ext_ior", ParamType::ior, std::string("air"),
       "Index of refraction outside (where the normal points): a number or a material's name."}};
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
       "Index of refraction outside: a number or a material's name."}};
}

ComplexIor conductor_param(Params& params) {
  const std::string material = params.text("material");
  const double outside = ior_param(params, "ext_eta");
  ComplexIor ior;
  if (material == "none") {
    ior = {index_param(params, "eta"), index_param(params, "k")};
  } else {
    for (const char* name : {"eta", "k"})
      if (params.has(name)) params.fail(name, "cannot be given together with a material");
    ior = find_conductor(material).value();
  }
  return {ior.eta / outside, ior.k / outside};
}

}  // namespace mlt
