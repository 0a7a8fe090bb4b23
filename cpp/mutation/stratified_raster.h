// Image positions that cover the image evenly over the chains of a group, never over the steps of
// one chain (Veach & Guibas 1997, sec. 5.3.3: the lens subpath mutation).
#pragma once

#include "math/permutation.h"
#include "scene/camera.h"

namespace mlt {

/// A raster position that is uniform for one chain and stratified over the `count` chains of a
/// group: that of chain `number`. `key` names the step that all of them take.
struct StratifiedRaster {
  uint32_t number = 0, count = 1;
  uint64_t key = 0;

  Vec2 position(const Raster& raster) const {
    return raster.sample(stratified_point(number, count, key));
  }
};

}  // namespace mlt
