#include "mutation/target_map.h"

#include "base/error.h"

#include <algorithm>
#include <numeric>

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
  return index(x, y);
}

void TargetMap::add(const Vec2& raster, double brightness) {
  factors_[cell_at(raster)] += brightness;
}

void TargetMap::add(const TargetMap& other) {
  for (size_t i = 0; i < factors_.size(); ++i) factors_[i] += other.factors_[i];
}

double TargetMap::brightest_neighbour(int x, int y) const {
  double brightest = 0;
  for (int v = std::max(0, y - 1); v <= std::min(rows_ - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(columns_ - 1, x + 1); ++u)
      if (u != x || v != y) brightest = std::max(brightest, factors_[index(u, v)]);
  return brightest;
}

double TargetMap::smoothed(const std::vector<double>& cells, int x, int y) const {
  double sum = 0, weights = 0;
  for (int v = std::max(0, y - 1); v <= std::min(rows_ - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(columns_ - 1, x + 1); ++u) {
      const double weight = (2 - std::abs(u - x)) * (2 - std::abs(v - y));  // a tent
      sum += weight * cells[index(u, v)];
      weights += weight;
    }
  return sum / weights;
}

void TargetMap::finish() {
  constexpr double least_share = 0.05;  // of the mean: no region is preferred more than 20 times
  // A cell brighter than all around it has had a rare sample, and chains would avoid its region.
  std::vector<double> limited = factors_;
  if (factors_.size() > 1)
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x)
        limited[index(x, y)] = std::min(limited[index(x, y)], brightest_neighbour(x, y));
  const double sum = std::accumulate(limited.begin(), limited.end(), 0.0);
  const double mean = sum / static_cast<double>(limited.size());
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x) {
      const double brightness = mean > 0 ? smoothed(limited, x, y) / mean : 1.0;
      factors_[index(x, y)] = 1 / std::max(least_share, brightness);
    }
}

void TargetMap::set_factors(std::vector<double> factors) {
  if (factors.size() != factors_.size()) throw RenderError("the saved target map has another size");
  factors_ = std::move(factors);
}

}  // namespace mlt
