// What filters weigh near the edges of an image beyond which there is no light: the light that is
// splatted there is divided by the share of the filter that lies inside.
#pragma once

#include "image/filter.h"

#include <vector>

namespace mlt {

/// The expected weight of a uniform sample in the cell at distance d from a pixel, for d = 0, 1 ...
std::vector<double> cell_weights(const Filter& filter);
/// The sum of these weights at a pixel over the cells begin ... end - 1.
double expected_weight(const std::vector<double>& cell_weights, int pixel, int begin, int end);

class EdgeScale {
 public:
  /// 1 everywhere.
  EdgeScale() = default;
  EdgeScale(const Filter& filter, int width, int height);

  /// The factor of the pixel at this place, row by row.
  double at(size_t pixel) const { return scale_.empty() ? 1 : scale_[pixel]; }

 private:
  std::vector<double> scale_;
};

}  // namespace mlt
