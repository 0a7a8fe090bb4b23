// What the pilot weighs noise by: the brightness of each region, in which a single bright sample
// does not show. Noise that such a sample makes must not be excused by the light that it found.
#pragma once

#include "math/vec.h"
#include "mutation/raster_cells.h"

#include <vector>

namespace mlt {

class TypicalBrightness {
 public:
  /// Cells of about 16 x 16 pixels over the sampled domain.
  explicit TypicalBrightness(const Raster& raster);

  /// Adds one sample of the image.
  void add(const Vec2& raster, double brightness);
  void add(const TypicalBrightness& other);
  /// Smooths the image, without single bright cells.
  void finish();

  /// The brightness at a raster position over the mean of the image, at least a share of it.
  double operator()(const Vec2& raster) const { return brightness_[cells_.at(raster)]; }

 private:
  double brightest_neighbour(int x, int y) const;
  double smoothed(int x, int y) const;
  template <class Value>
  std::vector<double> in_each_cell(Value&& value) const;

  RasterCells cells_;
  std::vector<double> brightness_;
};

}  // namespace mlt
