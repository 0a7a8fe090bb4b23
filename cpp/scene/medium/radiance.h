// The radiance of a medium that varies, as parameters: given as it is, or by temperatures.
#pragma once

#include "scene/volume/volume.h"

#include <vector>

namespace mlt {

/// The parameters `emission`, `emission_scale`, `temperature`, `temperature_scale`,
/// `temperature_offset` and `temperature_normalized`.
std::vector<Parameter> radiance_parameters();

class MediumRadiance {
 public:
  /// Throws SceneError if both are given, if temperatures have colours, or if it is too bright.
  explicit MediumRadiance(Params& params);

  Spectrum at(const Vec3& p, double wavelength) const;
  Color maximum() const { return maximum_; }

 private:
  double kelvin(double value) const { return (value - offset_) * kelvin_scale_; }
  void find_colors();
  double brightness(double kelvin) const;
  Spectrum black_body(double kelvin, double wavelength) const;

  VolumePtr volume_;  ///< Radiances or temperatures.
  double scale_, kelvin_scale_, offset_;
  bool normalized_, by_temperature_;
  double hottest_ = 0;         ///< In kelvin.
  std::vector<Color> colors_;  ///< Black bodies from 500 K to the hottest.
  Color maximum_{0};
};

}  // namespace mlt
