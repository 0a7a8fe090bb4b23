#include "mutation/target_map.h"

#include "base/error.h"

#include <algorithm>

namespace mlt {

TargetMap::TargetMap(const Raster& raster, int cell)
    : raster_(raster),
      columns_(std::max(1, (raster.size.x + cell - 1) / cell)),
      rows_(std::max(1, (raster.size.y + cell - 1) / cell)),
      factors_(static_cast<size_t>(columns_) * rows_) {}

size_t TargetMap::cell_at(const Vec2& raster) const {
  const Vec2 u = raster_.invert(raster);
  const int x = std::clamp(static_cast<int>(u.x * columns_), 0, columns_ - 1);
  const int y = std::clamp(static_cast<int>(u.y * rows_), 0, rows_ - 1);
  return static_cast<size_t>(y) * columns_ + x;
}

void TargetMap::add(const Vec2& raster, double brightness) {
  factors_[cell_at(raster)] += brightness;
}

void TargetMap::add(const TargetMap& other) {
  for (size_t i = 0; i < factors_.size(); ++i) factors_[i] += other.factors_[i];
}

void TargetMap::finish() {
  constexpr double least_share = 0.05;  // of the mean: no region is preferred more than 20 times
  const std::vector<double> coarse = factors_;
  double mean = 0;
  for (const double x : coarse) mean += x / static_cast<double>(coarse.size());
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x) {
      double sum = 0, weights = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (x + dx < 0 || x + dx >= columns_ || y + dy < 0 || y + dy >= rows_) continue;
          const double weight = (2 - std::abs(dx)) * (2 - std::abs(dy));  // a tent
          sum += weight * coarse[static_cast<size_t>(y + dy) * columns_ + x + dx];
          weights += weight;
        }
      const double brightness = mean > 0 ? sum / (weights * mean) : 1.0;
      factors_[static_cast<size_t>(y) * columns_ + x] = 1 / std::max(least_share, brightness);
    }
}

void TargetMap::set_factors(std::vector<double> factors) {
  if (factors.size() != factors_.size()) throw RenderError("the saved target map has another size");
  factors_ = std::move(factors);
}

}  // namespace mlt
