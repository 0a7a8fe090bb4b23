#include "job/brightness_pyramid.h"

namespace mlt {
namespace {

/// Means over blocks of 2 x 2; those at the right and lower border may be smaller.
std::vector<float> halved(const std::vector<float>& values, const Vec2i& size, const Vec2i& half) {
  std::vector<float> means(size_t(half.x) * half.y);
  for (int y = 0; y < half.y; ++y)
    for (int x = 0; x < half.x; ++x) {
      const int x1 = std::min(2 * x + 2, size.x), y1 = std::min(2 * y + 2, size.y);
      double sum = 0;
      for (int j = 2 * y; j < y1; ++j)
        for (int i = 2 * x; i < x1; ++i) sum += values[size_t(j) * size.x + i];
      means[size_t(y) * half.x + x] = static_cast<float>(sum / ((x1 - 2 * x) * (y1 - 2 * y)));
    }
  return means;
}

MeanWithError sum_without_outliers(const std::vector<const BrightnessPyramid*>& parts, size_t level,
                                   size_t i) {
  MeanWithError sum{0, 0};
  for (const BrightnessPyramid* part : parts) {
    const MeanWithError one = part->levels()[level].spread.without_outlier(i);
    sum.mean += one.mean;
    sum.variance += one.variance;
  }
  return sum;
}

}  // namespace

void BrightnessPyramid::add(std::vector<float> brightness, const Vec2i& size, double weight) {
  if (levels_.empty()) levels_.push_back({size, {}});
  while (levels_.back().size != Vec2i(1)) levels_.push_back({(levels_.back().size + 1) / 2, {}});
  for (size_t l = 0; l < levels_.size(); ++l) {
    if (l > 0) brightness = halved(brightness, levels_[l - 1].size, levels_[l].size);
    levels_[l].spread.add(brightness, weight);
  }
}

std::vector<float> known_brightness(const std::vector<const BrightnessPyramid*>& parts) {
  const auto& levels = parts.front()->levels();
  std::vector<float> coarse;
  for (size_t level = levels.size(); level-- > 0;) {
    const Vec2i size = levels[level].size;
    std::vector<float> fine(size_t(size.x) * size.y);
    for (size_t i = 0; i < fine.size(); ++i) {
      const MeanWithError seen = sum_without_outliers(parts, level, i);
      const size_t x = i % size.x, y = i / size.x;
      if (coarse.empty() || seen.variance <= sqr(seen.mean))
        fine[i] = static_cast<float>(seen.mean);
      else
        fine[i] = coarse[y / 2 * levels[level + 1].size.x + x / 2];
    }
    coarse = std::move(fine);
  }
  return coarse;
}

}  // namespace mlt
