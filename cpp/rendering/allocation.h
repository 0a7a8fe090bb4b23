// How a Metropolis render divides its time: the threshold c of ClampingWeights, which samples go to
// the image, and how many samples tours start from. All of it is efficiency alone; any value is
// right. It is found from independent samples, whose paths are not used again.
//
// In units of T, let V(c) be the variance within a pixel of a sample whose light is clamped at c,
// and e(c) what is clamped off, the integral of T'. With steps of the energy kappa0 = c / a, of
// which a count as an independent one, these are as bright as the brightest sample: chains add the
// variance c e(c), and take a e(c) / c steps per sample (a b / c of chains with the target T). A
// sample, a mutation and a start of tours, of which there are n per sample, take the times t_s, t_m
// and t_0. Then
//
//   J(c, n) = (V(c) + c e(c) + H(c, n)) (t_s + a e(c) / c t_m + n t_0)
//
// is the variance after a unit of time. The energy E / n of a start, E = T' / S, is spread over at
// most A pixels, an island in which tours move about. H is the variance of those that have more:
//
//   H(c, n) = E[E^2; E > n c A] / (n A).
#pragma once

#include "markov/clamping_weights.h"
#include "mutation/path_target.h"

#include <atomic>
#include <limits>
#include <optional>

namespace mlt {

class MetropolisAlgorithm;
struct CoarseImage;

struct Allocation {
  double share = 0;         ///< Share of the time for independent samples; 1: there are no chains.
  ClampingWeights weights;  ///< Weights of samples and chains.
  double mutations_per_sample = 1;                      ///< Cost of an independent sample.
  SampleTechniques techniques = SampleTechniques::all;  ///< Used by the samples.
  bool in_time = true;                                  ///< Whether there was time to find it.
  double brightness = 0;                                ///< A rough estimate of b.
  // For tours:
  double left = 0;             ///< Roughly e, what samples leave to them.
  double kappa0 = 1;           ///< See tour.h; per sample that they start from.
  double steps_per_start = 1;  ///< Expected work for such a sample, in mutations.
};

struct AllocationSettings {
  uint64_t seed = 0;
  int threads = 1;
  uint64_t samples = 0;                        ///< Number of samples of each kind.
  std::optional<double> share;                 ///< See Allocation; fixed if given.
  std::optional<SampleTechniques> techniques;  ///< See Allocation; fixed if given.
};

/// The division of a render without chains.
inline Allocation samples_alone(SampleTechniques techniques) {
  Allocation alone;
  alone.share = 1;
  alone.weights = ClampingWeights(std::numeric_limits<double>::max());
  alone.techniques = techniques;
  return alone;
}

/// The division of a render of tours without samples beside them.
Allocation tours_alone(double b, double steps_per_start);

/// Finds the division with the least J, where noise counts relative to the brightness that the
/// coarse image tells. Without any light for chains to start from, samples are left alone.
Allocation allocate(MetropolisAlgorithm& algorithm, const CoarseImage& coarse,
                    const AllocationSettings& settings, const std::atomic<bool>& cancelled);

}  // namespace mlt
