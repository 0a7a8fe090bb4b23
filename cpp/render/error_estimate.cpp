#include "render/error_estimate.h"

#include "math/color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

constexpr int channels = 4;            // R, G, B and the target luminance L of each pixel or block
constexpr int fewest_groups = 8;       // to speak of a disagreement
constexpr double largest_share = 0.5;  // of a block's light from one of them
constexpr double dark = 0.1;           // of the image's mean: below, blocks and pixels matter less

/// Weighted mean and variance, value by value. D. West, "Updating mean and variance estimates: an
/// improved method", CACM 1979.
class Spread {
 public:
  void add(const std::vector<float>& values, double weight) {
    if (mean_.empty()) {
      mean_.resize(values.size());
      squares_.resize(values.size());
    }
    weight_ += weight;
    ++count_;
    for (size_t i = 0; i < values.size(); ++i) {
      const double difference = values[i] - mean_[i];
      mean_[i] += static_cast<float>(difference * weight / weight_);
      squares_[i] += static_cast<float>(weight * difference * (values[i] - mean_[i]));
    }
  }

  int count() const { return count_; }
  const std::vector<float>& mean() const { return mean_; }
  /// Squared standard error of the mean.
  double variance(size_t i) const { return std::max(0.0f, squares_[i]) / ((count_ - 1) * weight_); }

 private:
  int count_ = 0;
  double weight_ = 0;
  std::vector<float> mean_, squares_;
};

std::vector<float> with_luminance(const Image& image) {
  std::vector<float> values;
  values.reserve(channels * image.pixel_count());
  for (size_t i = 0; i < image.data.size(); i += 3) {
    const Color rgb(image.data[i], image.data[i + 1], image.data[i + 2]);
    for (int c = 0; c < 3; ++c) values.push_back(image.data[i + c]);
    values.push_back(static_cast<float>(target_luminance(rgb)));
  }
  return values;
}

Vec2i block_grid(const Image& image) {
  constexpr int n = ErrorEstimate::block_size;
  return Vec2i((image.width + n - 1) / n, (image.height + n - 1) / n);
}

/// Means over blocks; those at the right and lower border may be smaller.
std::vector<float> block_means(const std::vector<float>& values, const Vec2i& size,
                               const Vec2i& grid) {
  constexpr int n = ErrorEstimate::block_size;
  std::vector<float> means;
  means.reserve(size_t{channels} * grid.x * grid.y);
  for (int by = 0; by < grid.y; ++by)
    for (int bx = 0; bx < grid.x; ++bx) {
      const int x1 = std::min(size.x, (bx + 1) * n), y1 = std::min(size.y, (by + 1) * n);
      double sum[channels] = {};
      for (int y = by * n; y < y1; ++y)
        for (int x = bx * n; x < x1; ++x)
          for (int c = 0; c < channels; ++c)
            sum[c] += values[channels * (size_t(y) * size.x + x) + c];
      const double count = double(x1 - bx * n) * (y1 - by * n);
      for (const double s : sum) means.push_back(static_cast<float>(s / count));
    }
  return means;
}

/// All groups of one rendering, over its pixels and over its blocks.
struct Groups {
  explicit Groups(const Rendering& rendering) {
    for (int g = 0; g < Rendering::group_count; ++g) {
      const GroupImage group = rendering.group(g);
      if (group.weight == 0) continue;
      size = Vec2i(group.image.width, group.image.height);
      grid = block_grid(group.image);
      const std::vector<float> values = with_luminance(group.image);
      const std::vector<float> means = block_means(values, size, grid);
      pixels.add(values, group.weight);
      blocks.add(means, group.weight);
      weight += group.weight;
      most.resize(means.size() / channels);
      for (size_t b = 0; b < most.size(); ++b)
        most[b] = std::max(most[b], group.weight * means[channels * b + 3]);
    }
  }

  Vec2i size{0}, grid{0};
  Spread pixels, blocks;
  double weight = 0;
  std::vector<double> most;  ///< Per block: light that one group has found, times its weight.
};

double mean_luminance(const std::vector<float>& values) {
  double sum = 0;
  for (size_t i = 3; i < values.size(); i += channels) sum += values[i];
  return channels * sum / static_cast<double>(values.size());
}

/// Mean and squared standard error of what several independent sets of groups add up to.
struct Total {
  std::vector<float> mean, variance;

  void add(const Spread& spread) {
    mean.resize(spread.mean().size());
    variance.resize(mean.size());
    for (size_t i = 0; i < mean.size(); ++i) {
      mean[i] += spread.mean()[i];
      variance[i] += static_cast<float>(spread.variance(i));
    }
  }

  void add_error(const std::vector<float>& errors) {
    for (size_t i = 0; i < errors.size(); ++i) variance[i] += errors[i] * errors[i];
  }

  Image error(const Vec2i& size) const {
    Image image(size.x, size.y, 3);
    for (size_t i = 0; i < image.data.size(); ++i)
      image.data[i] = std::sqrt(variance[i / 3 * channels + i % 3]);
    return image;
  }

  double relative() const {
    const double floor = sqr(dark * mean_luminance(mean));
    if (!(floor > 0)) return std::numeric_limits<double>::quiet_NaN();  // no light was found yet
    double sum = 0;
    for (size_t i = 3; i < mean.size(); i += channels)
      if (variance[i] > 0) sum += variance[i] / (sqr(double(mean[i])) + floor);
    return std::sqrt(channels * sum / static_cast<double>(mean.size()));
  }
};

std::vector<Disagreement> disagreements(const Groups& groups, const Total& blocks) {
  if (groups.pixels.count() < fewest_groups) return {};
  const double least = dark * mean_luminance(blocks.mean);
  std::vector<std::pair<float, Disagreement>> found;
  for (size_t b = 0; b < groups.most.size(); ++b) {
    const float light = blocks.mean[channels * b + 3];
    const double share = groups.most[b] / (groups.weight * light);
    if (!(light > least) || share <= largest_share) continue;
    const Vec2i block(b % groups.grid.x, b / groups.grid.x);
    found.push_back({light, {ErrorEstimate::block_size * block, std::min(1.0, share)}});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Disagreement> sorted;
  for (const auto& [light, disagreement] : found) sorted.push_back(disagreement);
  return sorted;
}

}  // namespace

ErrorEstimate estimate_error(const Rendering& rendering) {
  const Groups groups(rendering);
  ErrorEstimate estimate;
  estimate.groups = groups.pixels.count();
  if (estimate.groups < 2) return estimate;
  Total pixels, blocks;
  pixels.add(groups.pixels);
  blocks.add(groups.blocks);
  for (const Rendering* part : rendering.parts()) {
    const Groups groups_of_part(*part);
    if (groups_of_part.pixels.count() < 2) return estimate;
    pixels.add(groups_of_part.pixels);
    blocks.add(groups_of_part.blocks);
  }
  if (const Image common = rendering.common_error(); !common.empty()) {
    const std::vector<float> values = with_luminance(common);
    pixels.add_error(values);
    blocks.add_error(block_means(values, groups.size, groups.grid));
  }
  estimate.pixels = pixels.error(groups.size);
  estimate.blocks = blocks.error(groups.grid);
  estimate.relative = pixels.relative();
  estimate.relative_blocks = blocks.relative();
  estimate.disagreements = disagreements(groups, blocks);
  return estimate;
}

std::vector<NamedImage> error_layers(const ErrorEstimate& estimate) {
  if (estimate.pixels.empty()) return {};
  Image spread(estimate.pixels.width, estimate.pixels.height, 3);
  for (int y = 0; y < spread.height; ++y)
    for (int x = 0; x < spread.width; ++x)
      for (int c = 0; c < 3; ++c)
        spread.at(x, y, c) =
            estimate.blocks.at(x / ErrorEstimate::block_size, y / ErrorEstimate::block_size, c);
  return {{"error", estimate.pixels}, {"error_block", std::move(spread)}};
}

void add_error(const ErrorEstimate& estimate, Stats& stats) {
  constexpr size_t most = 10;
  stats.groups = estimate.groups;
  stats.error = estimate.relative;
  stats.block_error = estimate.relative_blocks;
  const std::vector<Disagreement>& all = estimate.disagreements;
  if (all.empty()) return;
  for (size_t i = 0; i < std::min(most, all.size()); ++i)
    stats.disagreements.push_back({all[i].pixel.x, all[i].pixel.y, all[i].share});
  stats.warnings.push_back(fmt::format(
      "in {} of {} blocks of 8 x 8 pixels one of {} independent groups has found most of the "
      "light, the brightest at pixel ({}, {}); to have these right too, give the render more time, "
      "or look whether another integrator finds this light more easily",
      all.size(), estimate.block_count(), estimate.groups, all[0].pixel.x, all[0].pixel.y));
}

}  // namespace mlt
