#include "scene/medium/coefficients.h"

#include "scene/medium/presets.h"
#include "scene/texture/texture.h"

#include <fmt/format.h>

namespace mlt {

Coefficients::Coefficients(Params& params)
    : by_albedo_(params.has("sigma_t") || params.has("albedo")),
      scale_(params.real_in("scale", 0, 1e12)) {
  const bool by_parts = params.has("sigma_s") || params.has("sigma_a");
  if (by_albedo_ + by_parts + params.has("material") > 1)
    params.fail("is given twice: give sigma_t and albedo, or sigma_s and sigma_a, or material");
  const auto coefficient = [&](const char* name) {
    return spectral_param(params, name).meaning(RgbMeaning::coefficient);
  };
  if (params.has("material")) {
    const MediumPreset& preset = medium_preset(params, "material");
    first_ = {preset.reduced_scattering(), RgbMeaning::coefficient};
    second_ = {preset.absorption, RgbMeaning::coefficient};
  } else if (by_parts) {
    first_ = coefficient("sigma_s");
    second_ = coefficient("sigma_a");
  } else {
    by_albedo_ = true;
    first_ = coefficient("sigma_t");
    second_ = spectral_param(params, "albedo");
  }
}

bool Coefficients::grey() const {
  return is_grey(at(rgb_lanes).extinction) && first_.grey() && (by_albedo_ || second_.grey());
}

Parameter emission_parameter(ParamType type) {
  return {"emission", type, 0.0,
          "Radiance where the medium is thick; per unit of length it emits sigma_a times that."};
}

std::vector<Parameter> coefficient_parameters() {
  return {
      {"sigma_t", ParamType::radiance, 1.0, "Extinction coefficient, per unit of length."},
      {"albedo", ParamType::reflectance, 0.75, "Share of the extinction that is scattered."},
      {"sigma_s", ParamType::radiance, 0.0,
       "Scattering coefficient, per unit of length; with sigma_a instead of sigma_t and albedo."},
      {"sigma_a", ParamType::radiance, 0.0, "Absorption coefficient, per unit of length."},
      {"material", ParamType::text, no_default,
       fmt::format("A measured material instead of coefficients, in millimetres: {}.",
                   fmt::join(medium_preset_names(), ", "))},
      {"scale", ParamType::real, 1.0, "Factor of all coefficients."}};
}

}  // namespace mlt
