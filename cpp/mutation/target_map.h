// Two-stage sampling (Veach & Guibas 1997, sec. 5.4; Veach 1997, sec. 11.4.3): a coarse image tells
// how bright each region is, and the target is divided by it, so that dark regions get their share
// of the mutations. Any positive map is right; a good one spreads the noise evenly.
#pragma once

#include "math/color.h"
#include "mutation/raster_cells.h"

#include <vector>

namespace mlt {

class TargetMap {
 public:
  /// Cells of about `cell` pixels over the sampled domain.
  TargetMap(const Raster& raster, int cell);

  /// Adds one sample of the coarse image.
  void add(const Vec2& raster, double brightness);
  void add(const TargetMap& other);
  /// Smooths the coarse image, without single bright cells, and turns it into factors: 1 over the
  /// brightness, at least a share of the mean.
  void finish();

  /// The factor of the target at a raster position.
  double operator()(const Vec2& raster) const { return factors_[cells_.at(raster)]; }

  const std::vector<double>& factors() const { return factors_; }
  void set_factors(std::vector<double> factors);

 private:
  double brightest_neighbour(int x, int y) const;
  double smoothed(const std::vector<double>& cells, int x, int y) const;

  RasterCells cells_;
  std::vector<double> factors_;
};

/// Without any sample yet, of 16 x 16 pixels a cell.
inline TargetMap blank_image(const Raster& raster) { return TargetMap(raster, 16); }

}  // namespace mlt
