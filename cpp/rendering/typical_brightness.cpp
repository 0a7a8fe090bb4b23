#include "rendering/typical_brightness.h"

#include <algorithm>
#include <numeric>

namespace mlt {

TypicalBrightness::TypicalBrightness(const Raster& raster)
    : cells_(RasterCells::of(raster, 16)), brightness_(cells_.count()) {}

void TypicalBrightness::add(const Vec2& raster, double brightness) {
  brightness_[cells_.at(raster)] += brightness;
}

void TypicalBrightness::add(const TypicalBrightness& other) {
  for (size_t i = 0; i < brightness_.size(); ++i) brightness_[i] += other.brightness_[i];
}

double TypicalBrightness::brightest_neighbour(int x, int y) const {
  double brightest = 0;
  cells_.for_neighbours(x, y, [&](int u, int v) {
    if (u != x || v != y) brightest = std::max(brightest, brightness_[cells_.index(u, v)]);
  });
  return brightest;
}

double TypicalBrightness::smoothed(int x, int y) const {
  double sum = 0, weights = 0;
  cells_.for_neighbours(x, y, [&](int u, int v) {
    const double weight = (2 - std::abs(u - x)) * (2 - std::abs(v - y));  // a tent
    sum += weight * brightness_[cells_.index(u, v)];
    weights += weight;
  });
  return sum / weights;
}

template <class Value>
std::vector<double> TypicalBrightness::in_each_cell(Value&& value) const {
  std::vector<double> values;
  for (int y = 0; y < cells_.rows; ++y)
    for (int x = 0; x < cells_.columns; ++x) values.push_back(value(x, y));
  return values;
}

void TypicalBrightness::finish() {
  constexpr double least_share = 0.05;
  if (brightness_.size() > 1)
    brightness_ = in_each_cell([&](int x, int y) {
      return std::min(brightness_[cells_.index(x, y)], brightest_neighbour(x, y));
    });
  const double mean = std::accumulate(brightness_.begin(), brightness_.end(), 0.0) /
                      static_cast<double>(brightness_.size());
  brightness_ = in_each_cell(
      [&](int x, int y) { return mean > 0 ? std::max(least_share, smoothed(x, y) / mean) : 1.0; });
}

}  // namespace mlt
