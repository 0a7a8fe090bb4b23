#include "image/edge_scale.h"

#include "image/splat.h"

namespace mlt {

std::vector<double> cell_weights(const Filter& filter) {
  std::vector<double> weights;
  if (filter.is_box()) return {1};
  constexpr int steps = 4096;
  for (int d = 0; d <= filter_border(filter); ++d) {
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += filter.eval(d - 0.5 + (i + 0.5) / steps);
    weights.push_back(sum / steps);
  }
  return weights;
}

double expected_weight(const std::vector<double>& cell_weights, int pixel, int begin, int end) {
  const int reach = static_cast<int>(cell_weights.size()) - 1;
  double sum = 0;
  for (int cell = std::max(begin, pixel - reach); cell < std::min(end, pixel + reach + 1); ++cell)
    sum += cell_weights[std::abs(cell - pixel)];
  return sum;
}

EdgeScale::EdgeScale(const Filter& filter, int width, int height) {
  if (filter.is_box()) return;
  const std::vector<double> weights = cell_weights(filter);
  scale_.reserve(size_t(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      scale_.push_back(
          1 / (expected_weight(weights, x, 0, width) * expected_weight(weights, y, 0, height)));
}

}  // namespace mlt
