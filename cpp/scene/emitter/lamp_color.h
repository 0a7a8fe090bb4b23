// The colour of a lamp that has one everywhere, which may change over time.
#pragma once

#include "scene/texture/animation.h"

namespace mlt {

class LampColor {
 public:
  /// A parameter of type lamp.
  LampColor(Params& params, const std::string& name)
      : animation_(lamp_animation(params, name)),
        still_(animation_ ? SpectralColor() : spectral_param(params, name)) {}

  Spectrum at(const SurfacePoint& x0) const {
    return animation_ ? animation_->eval(x0) : still_.at(x0.wavelength);
  }
  /// The mean while the shutter is open.
  Color mean() const { return animation_ ? animation_->mean() : still_.rgb(); }

 private:
  TexturePtr animation_;  ///< Null if it does not change.
  SpectralColor still_;
};

}  // namespace mlt
