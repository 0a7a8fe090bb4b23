// Light that goes straight on, through surfaces and through media. What it passes is a part of an
// edge, not a vertex: connections go through windows, leaves and fog.
#pragma once

#include "math/spectrum.h"

namespace mlt {

/// A walk flies through media as if it had drawn one of the channels when it began, and had not
/// told which: the probability of a leg is the mean over the channels, by their likelihood. That is
/// how probable what the walk has flown before is in each of them, over its mean; so the
/// probabilities of all legs multiply to the mean over the channels of those of the whole walk (for
/// wavelengths: Wilkie et al. 2014, "Hero wavelength spectral sampling"). In grey media it stays 1.
struct Passage {
  Spectrum transmittance{1};  ///< The share of the light that passes.
  double probability = 1;     ///< That a walk does not stop at one of the surfaces.
  Spectrum flight{1};         ///< e^-tau of the media in which walks may stop.
  Spectrum likelihood{1};     ///< That with which a leg begins.

  static Passage blocked() { return {Spectrum(0), 0}; }
  bool is_blocked() const { return is_black(transmittance); }
  Passage& operator*=(const Passage& next) {
    transmittance *= next.transmittance;
    probability *= next.probability;
    flight *= next.flight;
    return *this;
  }
};

/// How a walk goes along an edge and stops at its end.
struct Arrival {
  double stops = 1;   ///< The probability that surfaces let it pass, and that of the end does not.
  Spectrum flies{1};  ///< e^-tau, times sigma_t where it stops in a medium.
  Spectrum likelihood{1};  ///< That with which it begins.

  Arrival after(const Spectrum& before) const { return {stops, flies, before}; }
  /// The probability, in a medium per unit of length, that is due to media.
  double flown() const { return mean(likelihood * flies); }
  double probability() const { return stops * flown(); }
  /// The likelihood with which the walk goes on.
  Spectrum next_likelihood() const {
    const double p = flown();
    return p > 0 ? likelihood * flies / p : Spectrum(1);
  }
};

}  // namespace mlt
