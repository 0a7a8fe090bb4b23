// Image positions that cover the image evenly over the chains of a round, never over the steps of one
// chain (Veach & Guibas 1997, sec. 5.3.3: the lens subpath mutation).
#pragma once

#include "math/permutation.h"
#include "scene/camera.h"

namespace mlt {

/// A raster position that is uniform for one chain and stratified over all chains of a round: that of
/// chain `number` of `count`. `key` names the round.
struct StratifiedRaster {
  const Raster* raster = nullptr;
  uint32_t number = 0, count = 1;
  uint64_t key = 0;

  Vec2 position() const { return raster->sample(stratified_point(number, count, key)); }
};

/// For a chain on its own: uniform.
inline StratifiedRaster unstratified(const Raster& raster, Rng& rng) {
  return {&raster, 0, 1, rng.next_bits()};
}

}  // namespace mlt
