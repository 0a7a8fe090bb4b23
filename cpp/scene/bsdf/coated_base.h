// The diffuse base of a plastic, below a dielectric coating: how much light it scatters, with all
// reflections between it and the coating.
#pragma once

#include "base/params.h"
#include "scene/texture.h"

namespace mlt {

class CoatedBase {
 public:
  /// The parameters `diffuse_reflectance` and `nonlinear`, and `specular_reflectance`, which is for
  /// the coating: the material itself reads it.
  static std::vector<Parameter> parameters();

  /// `eta` of the coating against the outside; the mean reflectance of the coating from inside.
  CoatedBase(Params& params, double eta, double internal_reflectance);

  /// The BSDF without the transmittances of the coating in the two directions.
  Color eval(const SurfacePoint& at) const { return scattered(reflectance_->eval(at)); }
  Color reflectance(const SurfacePoint& at) const { return reflectance_->eval(at); }

  /// pi times the mean of eval, as one number: for sampling probabilities.
  double weight() const;

 private:
  Color scattered(const Color& d) const {
    return d * scale_ /
           (nonlinear_ ? Color(1) - d * internal_reflectance_ : Color(1 - internal_reflectance_));
  }

  TexturePtr reflectance_;
  bool nonlinear_;
  double internal_reflectance_;
  double scale_;  ///< 1 / (pi eta^2): radiance spreads when it leaves the denser medium.
};

}  // namespace mlt
