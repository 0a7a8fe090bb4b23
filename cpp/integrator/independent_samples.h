// Independent samples beside the chains: they show a part of the image, and tell b.
#pragma once

#include "integrator/metropolis_algorithm.h"
#include "integrator/weight_sums.h"

namespace mlt {

/// Draws a sample and adds it to `sums`; calls record(found) for each of its paths. Returns how many
/// of these were invalid, and left out.
template <class Sampler, class Record>
uint64_t take_sample(MetropolisAlgorithm::Source& source, Sampler sampler,
                     const FamilyWeights& weights, SampleSums& sums, Record&& record) {
  double target = 0, brightness = 0, of_chains = 0;
  uint64_t invalid = 0;
  for (const FoundLight& found : source.sample(sampler)) {
    if (!found.valid()) {
      ++invalid;
      continue;
    }
    const double luminance = target_luminance(found.rgb);
    target += found.weight;
    brightness += luminance;
    of_chains += luminance * weights.of_chain(found.target_over_density);
    record(found);
  }
  sums.add(target, brightness, of_chains);
  return invalid;
}

/// Some of the samples of a group: numbers part, part + parts, part + 2 parts, ... of a stratified
/// sequence over the whole image.
class IndependentSamples {
 public:
  IndependentSamples(const MetropolisAlgorithm& algorithm, uint64_t stream, uint32_t part,
                     uint32_t parts)
      : source_(algorithm.source()), stream_(stream), part_(part), parts_(parts) {}

  /// Leaves on the film what the samples are believed, times `scale`.
  void advance(uint64_t samples, SplatFilm& film, int group, const FamilyWeights& weights,
               double scale);

  const SampleSums& sums() const { return sums_; }
  RayCounts rays() const;
  uint64_t invalid() const { return invalid_; }
  void save(ByteWriter& bytes) const;
  void load(ByteReader& bytes);

 private:
  std::unique_ptr<MetropolisAlgorithm::Source> source_;
  uint64_t stream_;
  uint32_t part_, parts_;
  SampleSums sums_;
  RayCounts rays_before_;  ///< Those that were traced before the state was saved.
  uint64_t invalid_ = 0;
};

}  // namespace mlt
