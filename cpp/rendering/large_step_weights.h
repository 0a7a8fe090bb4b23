// How pssmlt weights the states that its steps record.
#pragma once

#include "primary/primary_step.h"
#include "rendering/metropolis_algorithm.h"

namespace mlt {

/// The proposals of large steps are independent samples, with the density 1 of the numbers, and all
/// are recorded. A step of a chain records states with the density T / b, and p_large times
/// others with the density 1; weighted as samples of both (Kelemen et al. 2002, sec. 4.4), a state
/// counts rgb / (T + p_large b). Any fixed number in the place of b is right: it is that of the
/// pilot.
struct LargeStepWeights {
  double share = 0;  ///< p_large times that number.

  double denominator(double target) const { return target + share; }
  /// A part of the light of a sample whose target is T.
  FoundLight found(const ImageLight& light, double target) const {
    return {light.raster, light.rgb, target_luminance(light.rgb), denominator(target),
            light.own_pixel};
  }
};

}  // namespace mlt
