#include "job/blocks_of_sequence.h"

#include <cmath>
#include <numeric>

namespace mlt {
namespace {

/// With fewer pixels that carry the noise, chance decides what joining blocks seems to gain.
constexpr double fewest_pixels = 8;

/// Sums over pixels, relative to their brightness.
struct Sums {
  double first = 0;          ///< V_0.
  double first_squared = 0;  ///< V_0^2.
  double last = 0;           ///< V_K.

  Sums& operator+=(const Sums& other) {
    first += other.first;
    first_squared += other.first_squared;
    last += other.last;
    return *this;
  }
  bool tell() const { return sqr(first) > fewest_pixels * first_squared; }
};

/// The sums over tile (x, y) and its neighbours.
Sums around(const std::vector<Sums>& tiles, const Vec2i& grid, int x, int y) {
  Sums sums;
  for (int v = std::max(0, y - 1); v <= std::min(grid.y - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(grid.x - 1, x + 1); ++u)
      sums += tiles[size_t(v) * grid.x + u];
  return sums;
}

}  // namespace

void BlocksOfSequence::add(std::vector<float> brightness, double weight) {
  for (size_t k = 0;; ++k) {
    if (k == levels_.size()) levels_.emplace_back();
    Level& level = levels_[k];
    if (level.first.empty()) {
      level.first = std::move(brightness);
      level.first_weight = weight;
      return;
    }
    level.blocks.add(level.first, level.first_weight);
    level.blocks.add(brightness, weight);
    weight += level.first_weight;
    const auto share = static_cast<float>(level.first_weight / weight);
    for (size_t i = 0; i < brightness.size(); ++i)
      brightness[i] += share * (level.first[i] - brightness[i]);
    level.first.clear();
  }
}

std::vector<float> BlocksOfSequence::remaining(const Vec2i& size, int n) const {
  const Vec2i grid = (size + (n - 1)) / n;
  std::vector<float> remaining(size_t(grid.x) * grid.y, 1.0f);
  if (levels_.size() < 3) return remaining;
  const size_t most_joins = levels_.size() - 2;  // K
  const Spread &groups = levels_[0].blocks, &largest = levels_[most_joins].blocks;
  const std::vector<float>& mean = groups.mean();
  const double brightness =
      std::accumulate(mean.begin(), mean.end(), 0.0) / static_cast<double>(mean.size());
  std::vector<Sums> tiles(remaining.size());
  for (int y = 0, i = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x, ++i) {
      const double relative = 1 / (sqr(mean[i]) + 0.01 * sqr(brightness)),
                   variance = relative * groups.weight() * groups.variance(i);
      tiles[size_t(y / n) * grid.x + x / n] +=
          {variance, sqr(variance), relative * largest.weight() * largest.variance(i)};
    }
  const double joins = std::log2(groups.count()) / static_cast<double>(most_joins);
  for (int y = 0, i = 0; y < grid.y; ++y)
    for (int x = 0; x < grid.x; ++x, ++i)
      if (const Sums sums = around(tiles, grid, x, y); sums.tell() && sums.last < sums.first)
        remaining[i] = static_cast<float>(std::pow(sums.last / sums.first, joins));
  return remaining;
}

}  // namespace mlt
