// The diffuse base of a plastic, below a dielectric coating: its albedo, with all reflections
// between it and the coating, and the probability of sampling it.
#pragma once

#include "base/params.h"
#include "scene/bsdf/lobes.h"
#include "scene/texture/texture.h"

namespace mlt {

class CoatedBase {
 public:
  static std::vector<Parameter> parameters();

  /// `eta` of the coating against the outside; for diffuse light, its mean reflectance from inside
  /// and its mean transmittance from outside.
  CoatedBase(Params& params, double eta, double internal_reflectance, double mean_transmittance);

  /// The BSDF without the transmittances of the coating in the two directions.
  Spectrum eval(const SurfacePoint& at) const { return scattered(reflectance_->eval(at)); }
  /// The factor of the coating's reflection.
  Spectrum specular(const SurfacePoint& at) const { return specular_->eval(at); }
  Spectrum albedo(const SurfacePoint& at) const;

  /// The coating's share of the light that it and the base reflect from one direction, if the
  /// coating reflects and transmits these fractions.
  template <class F>
  F specular_share(const F& reflectance, const F& transmittance) const {
    return first_share(reflectance * number<F>(specular_weight_),
                       transmittance * number<F>(diffuse_weight_));
  }

 private:
  /// What the base scatters with a reflectance d, a Spectrum or a Color.
  template <class T>
  T scattered(const T& d) const {
    return d * scale_ /
           (nonlinear_ ? T(1) - d * internal_reflectance_ : T(1 - internal_reflectance_));
  }

  double eta_;
  TexturePtr reflectance_, specular_;
  bool nonlinear_;
  double internal_reflectance_;
  double scale_;  ///< 1 / (pi eta^2): radiance spreads when it leaves the denser medium.
  double specular_weight_, diffuse_weight_;
};

}  // namespace mlt
