#include "scene/bsdf/glossy_over_diffuse.h"

namespace mlt {
namespace {

/// The factor of both reflectances that keeps their sum below 1: the rule of Mitsuba 0.6, which
/// leaves a margin of 1 % if it is needed.
double energy_scale(const Color& largest) {
  const double sum = max_component(largest);
  return sum > 1 ? 0.99 / sum : 1;
}

}  // namespace

std::vector<Parameter> GlossyReflectances::parameters() {
  return {{"specular_reflectance", ParamType::texture, 0.2, "Reflectance of the glossy lobe."},
          {"diffuse_reflectance", ParamType::texture, 0.5, "Reflectance of the diffuse part."},
          {"ensure_energy_conservation", ParamType::boolean, true,
           "If the largest values of both reflectances add up to more than 1, scale both so that "
           "they add up to 0.99. Without it the surface may reflect more than it receives."}};
}

GlossyReflectances::GlossyReflectances(Params& params)
    : diffuse(texture_param(params, "diffuse_reflectance")),
      specular(texture_param(params, "specular_reflectance")) {
  if (params.boolean("ensure_energy_conservation"))
    scale = energy_scale(diffuse->maximum() + specular->maximum());
  specular_share =
      first_share(target_luminance(specular->mean()), target_luminance(diffuse->mean()));
}

}  // namespace mlt
