// Light that goes straight on, through surfaces and through media. What it passes is a part of an
// edge, not a vertex: connections go through windows, leaves and fog.
#pragma once

#include "math/color.h"

namespace mlt {

/// A walk flies through media with the probability that is the mean of `flight` over its channels:
/// each leg is as if it had drawn one of the three at random.
struct Passage {
  Color transmittance{1};  ///< The share of the light that passes.
  double probability = 1;  ///< That a walk does not stop at one of the surfaces.
  Color flight{1};         ///< e^-tau of the media in which walks may stop.

  static Passage blocked() { return {Color(0), 0}; }
  bool is_blocked() const { return is_black(transmittance); }
  Passage& operator*=(const Passage& next) {
    transmittance *= next.transmittance;
    probability *= next.probability;
    flight *= next.flight;
    return *this;
  }
};

}  // namespace mlt
