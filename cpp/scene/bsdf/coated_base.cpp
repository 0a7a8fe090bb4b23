#include "scene/bsdf/coated_base.h"

namespace mlt {

std::vector<Parameter> CoatedBase::parameters() {
  return {{"diffuse_reflectance", ParamType::texture, 0.5, "Reflectance of the base."},
          {"nonlinear", ParamType::boolean, false,
           "Let the base colour the light that is reflected several times between it and the "
           "coating: more saturated."},
          {"specular_reflectance", ParamType::texture, 1.0, "Factor on the coating's reflection."}};
}

CoatedBase::CoatedBase(Params& params, double eta, double internal_reflectance)
    : reflectance_(texture_param(params, "diffuse_reflectance")),
      nonlinear_(params.boolean("nonlinear")),
      internal_reflectance_(internal_reflectance),
      scale_(inv_pi / (eta * eta)) {}

double CoatedBase::weight() const { return pi * target_luminance(scattered(reflectance_->mean())); }

}  // namespace mlt
