// The numbers by which one technique makes a path, selected from those of a whole sample of
// bidirectional path tracing: one technique reads only those that it needs, and none for Russian
// roulette.
#pragma once

#include "path/bidirectional_sampler.h"
#include "primary/primary_numbers.h"

namespace mlt {

class TechniqueNumbers {
 public:
  TechniqueNumbers(PrimaryNumbers& drawn, Rng& rng) : drawn_(&drawn), rng_(&rng) {}

  PrimaryNumbers of(const Technique& technique, const PathRules& rules) {
    const auto [s, t] = technique;
    copy_walk(Stream::camera, t - 2, rules);
    copy_walk(Stream::light, s - 2, rules);
    if (s == 1)
      for (size_t i = 0; i < 3; ++i) copy(Stream::direct, 3 * (t - 1) + i, i);
    return numbers_;
  }

 private:
  static constexpr size_t of_end = 5, of_direction = 3;

  void copy_walk(Stream stream, int directions, const PathRules& rules) {
    const size_t drawn = of_direction + (rules.rr_depth == PathRules::no_roulette ? 0 : 1);
    for (size_t i = 0; i < of_end; ++i) copy(stream, i, i);
    for (int d = 0; d < directions; ++d)
      for (size_t i = 0; i < of_direction; ++i)
        copy(stream, of_end + drawn * d + i, of_end + of_direction * d + i);
  }
  void copy(Stream stream, size_t from, size_t to) {
    numbers_.set(stream, to, drawn_->get(stream, from, {}, *rng_));
  }

  PrimaryNumbers* drawn_;
  Rng* rng_;
  PrimaryNumbers numbers_;
};

}  // namespace mlt
