#include "integrator/independent_samples.h"

#include <cmath>

namespace mlt {

void IndependentSamples::advance(uint64_t samples, SplatFilm& film, int group,
                                 const FamilyWeights& weights, double scale) {
  for (; samples > 0; --samples) {
    const uint64_t number = sums_.count() * parts_ + part_;
    const PixelSampler sampler(mix_bits(stream_ + (number >> 32)), static_cast<uint32_t>(number));
    invalid_ += take_sample(*source_, sampler, weights, sums_, [&](const FoundLight& found) {
      film.add(group, found.raster,
               found.rgb * (scale * weights.of_sample(found.target_over_density)));
    });
  }
}

double MetropolisAlgorithm::Source::weigh(Rng& rng) {
  double sum = 0;
  for (const FoundLight& found : sample(RandomSampler(rng)))
    if (found.valid()) sum += found.weight;
  return sum;
}

RayCounts IndependentSamples::rays() const {
  RayCounts sum = rays_before_;
  return sum += source_->rays();
}

void IndependentSamples::save(ByteWriter& bytes) const {
  sums_.save(bytes);
  bytes.write(rays());
  bytes.write(invalid_);
}

void IndependentSamples::load(ByteReader& bytes) {
  sums_.load(bytes);
  rays_before_ = bytes.read<RayCounts>();
  invalid_ = bytes.read<uint64_t>();
}

}  // namespace mlt
