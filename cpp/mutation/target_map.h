// Two-stage sampling (Veach & Guibas 1997, sec. 5.4; Veach 1997, sec. 11.4.3): a coarse image
// estimates the brightness of each region, and the target is divided by it, so that dark regions
// get their share of the mutations. Any positive map is right; a good one spreads noise evenly.
//
// The coarse image is made of few samples. The brightness of a cell is a mean of that of its own n
// samples and, with the weight of k samples, that of the block around it:
//
//   I = (n I_own + k I_block) / (n + k)
//
// and so is that of this block of 2 x 2 cells, and so on, up to the whole image (the posterior mean
// of a normal distribution whose prior weighs as much as k samples). Here n is the effective sample
// size of a block, (sum w)^2 / sum w^2 (L. Kish, "Survey sampling", 1965), shared among its
// parts, so that one bright sample counts as one, and an empty cell among bright ones is dark.
//
// A lamp that is seen, directly or by mirrors and glass, may be a thousand times as bright as what
// surrounds it. So light that is scattered before it comes to the lens is divided by its own
// brightness, and light that is not, whose `certainty` (path_terms.h) is above 0, by that of all.
#pragma once

#include "math/color.h"
#include "mutation/raster_cells.h"

#include <vector>

namespace mlt {

class TargetMap {
 public:
  /// A map with cells of about `cell` pixels over the sampled domain.
  TargetMap(const Raster& raster, int cell);

  /// Adds one sample of the coarse image.
  void add(const Vec2& raster, double brightness, double certainty = 0);
  void add(const TargetMap& other);
  /// Smooths the coarse image and turns it into factors: 1 over the brightness, at least a share of
  /// the mean.
  void finish();

  /// The factor of the target of a path of this certainty at a raster position.
  double operator()(const Vec2& raster, double certainty = 0) const {
    return factors_[(certainty > 0 ? 0 : cells_.count()) + cells_.at(raster)];
  }

  /// The factors of all light, and then of scattered light.
  const std::vector<double>& factors() const { return factors_; }
  void set_factors(std::vector<double> factors);

 private:
  RasterCells cells_;
  std::vector<double> factors_;  ///< Factors of the cells; before finish(), sums of brightness.
  std::vector<double> squares_;  ///< Sums of squares of the brightness.
};

/// An empty coarse image with cells of 8 x 8 pixels.
inline TargetMap blank_image(const Raster& raster) { return TargetMap(raster, 8); }

}  // namespace mlt
