#include "mutation/target_map.h"

#include "base/error.h"

#include <algorithm>
#include <numeric>

namespace mlt {

TargetMap::TargetMap(const Raster& raster, int cell)
    : cells_{raster, std::max(1, (raster.size.x + cell - 1) / cell),
             std::max(1, (raster.size.y + cell - 1) / cell)},
      factors_(cells_.count()) {}

void TargetMap::add(const Vec2& raster, double brightness) {
  factors_[cells_.at(raster)] += brightness;
}

void TargetMap::add(const TargetMap& other) {
  for (size_t i = 0; i < factors_.size(); ++i) factors_[i] += other.factors_[i];
}

double TargetMap::brightest_neighbour(int x, int y) const {
  double brightest = 0;
  cells_.for_neighbours(x, y, [&](int u, int v) {
    if (u != x || v != y) brightest = std::max(brightest, factors_[cells_.index(u, v)]);
  });
  return brightest;
}

double TargetMap::smoothed(const std::vector<double>& cells, int x, int y) const {
  double sum = 0, weights = 0;
  cells_.for_neighbours(x, y, [&](int u, int v) {
    const double weight = (2 - std::abs(u - x)) * (2 - std::abs(v - y));  // a tent
    sum += weight * cells[cells_.index(u, v)];
    weights += weight;
  });
  return sum / weights;
}

void TargetMap::finish() {
  constexpr double least_share = 0.05;  // of the mean: no region is preferred more than 20 times
  // A cell brighter than all around it has had a rare sample, and chains would avoid its region.
  std::vector<double> limited = factors_;
  if (factors_.size() > 1)
    for (int y = 0; y < cells_.rows; ++y)
      for (int x = 0; x < cells_.columns; ++x)
        limited[cells_.index(x, y)] =
            std::min(limited[cells_.index(x, y)], brightest_neighbour(x, y));
  const double sum = std::accumulate(limited.begin(), limited.end(), 0.0);
  const double mean = sum / static_cast<double>(limited.size());
  for (int y = 0; y < cells_.rows; ++y)
    for (int x = 0; x < cells_.columns; ++x) {
      const double brightness = mean > 0 ? smoothed(limited, x, y) / mean : 1.0;
      factors_[cells_.index(x, y)] = 1 / std::max(least_share, brightness);
    }
}

void TargetMap::set_factors(std::vector<double> factors) {
  if (factors.size() != factors_.size()) throw RenderError("the saved target map has another size");
  factors_ = std::move(factors);
}

}  // namespace mlt
