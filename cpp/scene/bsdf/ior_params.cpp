#include "scene/bsdf/ior_params.h"

#include "base/text.h"
#include "math/ior.h"
#include "math/ior_curves.h"
#include "scene/texture/texture.h"

namespace mlt {
namespace {

/// "cauchy A B", "sellmeier B1 B2 B3 C1 C2 C3" or "abbe n_d V_d"; nullopt for other words.
std::optional<RefractiveIndex> formula(const std::string& text) {
  const std::vector<std::string_view> words = split(text);
  std::vector<double> x;
  for (size_t i = 1; i < words.size(); ++i) {
    const auto number = parse_real(words[i]);
    if (!number) return std::nullopt;
    x.push_back(*number);
  }
  if (words.empty()) return std::nullopt;
  if (words[0] == "cauchy" && x.size() == 2) return RefractiveIndex::cauchy(x[0], x[1]);
  if (words[0] == "abbe" && x.size() == 2) return RefractiveIndex::abbe(x[0], x[1]);
  if (words[0] != "sellmeier" || x.empty() || x.size() % 2 != 0) return std::nullopt;
  std::vector<SellmeierTerm> terms;
  const size_t n = x.size() / 2;
  for (size_t i = 0; i < n; ++i) terms.push_back({x[i], x[n + i]});
  return RefractiveIndex::sellmeier(terms);
}

SideIndex named_index(Params& params, const std::string& name, const std::string& text) {
  if (const auto number = parse_real(text)) return {RefractiveIndex::constant(*number), *number};
  if (const auto found = formula(text)) return {*found, found->sodium()};
  const auto ior = find_dielectric(text);
  if (!ior)
    params.fail(name, "names no known material: '" + text + "'" +
                          suggestion(text, dielectric_names()) +
                          "; nor is it 'cauchy A B' (in nm^2), 'sellmeier B1 B2 B3 C1 C2 C3' (in "
                          "um^2) or 'abbe n_d V_d'");
  return {params.has(name) ? *find_dispersive(text) : RefractiveIndex::constant(*ior), *ior};
}

SideIndex index_of(Params& params, const std::string& name) {
  const Value& value = params.value(name);
  try {
    if (const auto* text = std::get_if<std::string>(&value))
      return named_index(params, name, *text);
    if (const auto* table = std::get_if<WavelengthTable>(&value)) {
      const RefractiveIndex curve = RefractiveIndex::table(*table);
      return {curve, curve.sodium()};
    }
    const double ior = params.real(name);
    if (!(ior > 0)) params.fail(name, "must be positive");
    return {RefractiveIndex::constant(ior), ior};
  } catch (const UsageError& error) {
    params.fail(name, std::string("is no index of refraction: ") + error.what());
  }
}

double ior_param(Params& params, const std::string& name) { return index_of(params, name).in_rgb; }

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
       "Index of refraction inside (below the surface): a number, a material's name, a table of "
       "wavelength:index pairs, or a formula as text: cauchy A B, sellmeier B1 B2 B3 C1 C2 C3, "
       "abbe "
       "n_d V_d."},
      {"ext_ior", ParamType::ior, std::string("air"),
       "Index of refraction outside (where the normal points), likewise."}};
}

std::vector<Parameter> interface_factors() {
  return {{"specular_reflectance", ParamType::texture, 1.0, "Factor on the reflection."},
          {"specular_transmittance", ParamType::texture, 1.0, "Factor on the refraction."}};
}

double relative_ior_param(Params& params) {
  const double inside = ior_param(params, "int_ior");
  return inside / ior_param(params, "ext_ior");
}

RelativeIndex relative_index_param(Params& params) {
  return {index_of(params, "int_ior"), index_of(params, "ext_ior")};
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
