// Inversion: the primary samples by which a technique makes a path (Bitterli, Jakob, Novak & Jarosz
// 2018, "Reversible jump Metropolis light transport using inverse mappings"; Otsu et al. 2017;
// Pantaleoni 2017).
#pragma once

#include "path/bidirectional_sampler.h"
#include "primary/primary_samples.h"

namespace mlt {

/// Sets the numbers from which BidirectionalSampler::sample_technique, without Russian roulette,
/// makes the path. Where there are many such numbers, as when several lobes may have sampled a
/// direction, they are drawn with the density that they have, given the path. False if the
/// technique cannot make it.
bool invert_path(const Scene& scene, const Path& path, const Technique& technique, Rng& rng,
                 PrimarySamples& numbers);

}  // namespace mlt
