// The common part of all interfaces between transparent media: the relative index of refraction,
// factors of reflection and transmission, and the probabilities of sampling them.
#pragma once

#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture.h"

namespace mlt {

class DielectricInterface {
 public:
  explicit DielectricInterface(Params& params)
      : eta(relative_ior_param(params)),
        reflectance(texture_param(params, "specular_reflectance")),
        transmittance(texture_param(params, "specular_transmittance")),
        reflection_weight_(target_luminance(reflectance->mean())),
        transmission_weight_(target_luminance(transmittance->mean())) {}

  /// Probability of choosing reflection where the fraction F is reflected: in proportion to the
  /// mean power of both.
  double reflection_probability(double F) const {
    return first_share(F * reflection_weight_, (1 - F) * transmission_weight_);
  }
  /// The albedo of an interface that reflects the fraction F.
  Spectrum albedo(const SurfacePoint& at, double F) const {
    return F * reflectance->eval(at) + (1 - F) * transmittance->eval(at);
  }

  double eta;
  TexturePtr reflectance, transmittance;

 private:
  double reflection_weight_, transmission_weight_;
};

}  // namespace mlt
