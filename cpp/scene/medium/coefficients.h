// The coefficients of a medium that is the same everywhere, as parameters.
#pragma once

#include "base/params.h"
#include "scene/medium/medium.h"
#include "scene/texture/spectral_color.h"

namespace mlt {

/// The parameters `sigma_t`, `albedo`, `sigma_s`, `sigma_a`, `material` and `scale`.
std::vector<Parameter> coefficient_parameters();

/// The parameter `emission`, a radiance or a volume.
Parameter emission_parameter(ParamType type);

class Coefficients {
 public:
  /// Throws SceneError if they are given twice.
  explicit Coefficients(Params& params);

  MediumCoefficients at(double wavelength) const {
    const Spectrum a = first_.at(wavelength), b = second_.at(wavelength);
    return by_albedo_ ? MediumCoefficients{scale_ * a, scale_ * (b * a)}
                      : MediumCoefficients{scale_ * (b + a), scale_ * a};
  }
  bool grey() const;

 private:
  /// sigma_s and sigma_a or, `by_albedo_`, sigma_t and the albedo.
  SpectralColor first_, second_;
  bool by_albedo_;
  double scale_;
};

}  // namespace mlt
