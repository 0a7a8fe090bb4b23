// Light that goes straight on through surfaces. A surface that is passed is a part of an edge, not
// a vertex: connections go through windows and leaves.
#pragma once

#include "math/color.h"

namespace mlt {

struct Passage {
  Color transmittance{1};  ///< The share of the light that passes.
  double probability = 1;  ///< That a walk goes on, and does not stop there.

  static Passage blocked() { return {Color(0), 0}; }
  bool is_blocked() const { return is_black(transmittance); }
  Passage& operator*=(const Passage& next) {
    transmittance *= next.transmittance;
    probability *= next.probability;
    return *this;
  }
};

}  // namespace mlt
