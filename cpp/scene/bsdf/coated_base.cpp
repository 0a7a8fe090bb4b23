#include "scene/bsdf/coated_base.h"

#include "math/fresnel.h"

namespace mlt {

std::vector<Parameter> CoatedBase::parameters() {
  return {{"diffuse_reflectance", ParamType::texture, 0.5, "Reflectance of the base."},
          {"nonlinear", ParamType::boolean, false,
           "Let the base colour the light that is reflected several times between it and the "
           "coating: more saturated."},
          {"specular_reflectance", ParamType::texture, 1.0, "Factor on the coating's reflection."}};
}

CoatedBase::CoatedBase(Params& params, double eta, double internal_reflectance,
                       double mean_transmittance)
    : eta_(eta),
      reflectance_(texture_param(params, "diffuse_reflectance")),
      specular_(texture_param(params, "specular_reflectance")),
      nonlinear_(params.boolean("nonlinear")),
      internal_reflectance_(internal_reflectance),
      scale_(inv_pi / (eta * eta)),
      specular_weight_(target_luminance(specular_->mean())),
      diffuse_weight_(pi * target_luminance(scattered(reflectance_->mean())) * mean_transmittance) {
}

Spectrum CoatedBase::albedo(const SurfacePoint& at) const {
  const double F = fresnel_dielectric(1, eta_).reflectance;
  return F * specular_->eval(at) + (1 - F) * reflectance_->eval(at);
}

}  // namespace mlt
