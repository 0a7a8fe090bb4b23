// The numbers by which one technique makes a path, selected from those of a whole sample of
// bidirectional path tracing: one technique reads only those that it needs.
#pragma once

#include "path/bidirectional_sampler.h"
#include "primary/primary_numbers.h"

namespace mlt {

class TechniqueNumbers {
 public:
  TechniqueNumbers(PrimaryNumbers& drawn, Rng& rng) : drawn_(&drawn), rng_(&rng) {}

  PrimaryNumbers of(const Technique& technique) {
    const auto [s, t] = technique;
    const size_t camera = count_of<Vec2> + count_of<LensNumbers>, direct = count_of<DirectNumbers>;
    copy(Stream::camera, 0, camera + count_of<StepNumbers> * std::max(0, t - 2));
    copy(Stream::light, 0, count_of<LightNumbers> + count_of<StepNumbers> * std::max(0, s - 2));
    if (s == 1) copy(Stream::direct, direct * (t - 1), direct);
    return numbers_;
  }

 private:
  void copy(Stream stream, size_t first, size_t count) {
    for (size_t i = 0; i < count; ++i)
      numbers_.set(stream, i, drawn_->get(stream, first + i, {}, *rng_));
  }

  PrimaryNumbers* drawn_;
  Rng* rng_;
  PrimaryNumbers numbers_;
};

}  // namespace mlt
