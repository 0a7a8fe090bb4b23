// The Fresnel reflectance of the metals of OpenPBR, "F82-tint": Schlick's, lowered by a tint at the
// cosine 1/7, about 82 degrees (Kutz, Hasan & Edmondson 2021, "Novel aspects of the Adobe Standard
// Material").
#pragma once

#include "math/number.h"
#include "math/spectrum.h"
#include "scene/bsdf/principled_terms.h"

namespace mlt {

/// What the reflectance depends on of the cosine: F = F0 + (1 - F0) schlick - edge_loss dip.
template <class F>
struct MetalAngle {
  F schlick{0}, dip{0};

  MetalAngle() = default;
  explicit MetalAngle(F cosine)
      : schlick(schlick_weight(cosine)),
        dip(max(F(0), cosine) * schlick * max(F(0), 1 - cosine) *
            number<F>(7 / (sqr(sqr(6. / 7)) * sqr(6. / 7)))) {}
  MetalAngle(F schlick, F dip) : schlick(schlick), dip(dip) {}
  MetalAngle<double> of_lane(int i) const { return {double(schlick[i]), double(dip[i])}; }
};

struct MetalColors {
  Spectrum normal;     ///< F0
  Spectrum edge_loss;  ///< What the tint takes of Schlick's reflectance at the cosine 1/7.

  MetalColors() = default;
  MetalColors(const Spectrum& f0, const Spectrum& tint)
      : normal(f0),
        edge_loss((Spectrum(1) - tint) *
                  (f0 + (Spectrum(1) - f0) * (sqr(sqr(6. / 7)) * (6. / 7)))) {}

  Spectrum at(const MetalAngle<double>& angle) const {
    return max(Spectrum(0),
               normal + (Spectrum(1) - normal) * angle.schlick - edge_loss * angle.dip);
  }
  /// The mean for diffuse light: those of Schlick's weight and of the dip are 1/21 and 0.1401.
  Spectrum mean() const { return at({1. / 21, 2. / 252 * 7 / (sqr(sqr(6. / 7)) * sqr(6. / 7))}); }
};

}  // namespace mlt
