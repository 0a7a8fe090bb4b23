#include "job/error_estimate.h"

#include "job/blocks_of_sequence.h"
#include "job/brightness_pyramid.h"
#include "math/color.h"

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

constexpr int channels = 4;            // R, G, B and the target luminance L of each pixel or block
constexpr int fewest_groups = 8;       // to speak of a disagreement
constexpr double largest_share = 0.5;  // of a block's light from one of them
constexpr double dark = 0.1;           // of the image's mean: below, blocks and pixels matter less
/// A pixel is taken to be at least this part as bright as its mean: it may be a light that one
/// group in eight has found, in a dark place.
constexpr double least_of_seen = 0.125;

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

std::vector<float> luminance_of(const std::vector<float>& values) {
  std::vector<float> luminance;
  luminance.reserve(values.size() / channels);
  for (size_t i = 3; i < values.size(); i += channels) luminance.push_back(values[i]);
  return luminance;
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

/// All groups of one rendering, over its pixels or over its blocks.
struct Groups {
  void add(const std::vector<float>& values, const Vec2i& size, double weight) {
    spread.add(values, weight);
    brightness.add(luminance_of(values), size, weight);
  }
  Spread spread;
  BrightnessPyramid brightness;
  /// For each pixel or block the share of the variance that stratification of all groups leaves.
  std::vector<float> remaining;
};

/// How the group of a render differs from `factor` times that of another one. Weights are in
/// proportion to 1 / variance, and so is that of the difference.
GroupImage difference(const GroupImage& from, float factor, GroupImage to) {
  if (from.weight == 0 || to.weight == 0) return {};
  for (size_t i = 0; i < to.image.data.size(); ++i) to.image.data[i] -= factor * from.image.data[i];
  to.weight = 1 / (sqr(factor) / from.weight + 1 / to.weight);
  return to;
}

/// The groups of a rendering; with `before`, how they differ from those of that one.
struct GroupsOfRendering {
  GroupsOfRendering(const Rendering& rendering, int layer,
                    const std::optional<ImageOf>& before = std::nullopt) {
    BlocksOfSequence sequence;
    for (int g = 0; g < Rendering::group_count; ++g) {
      GroupImage group = rendering.group(g, layer);
      if (before)
        group = difference(before->rendering->group(g, before->layer), before->factor,
                           std::move(group));
      if (group.weight == 0) continue;
      size = Vec2i(group.image.width, group.image.height);
      grid = block_grid(group.image);
      const std::vector<float> values = with_luminance(group.image);
      const std::vector<float> means = block_means(values, size, grid);
      pixels.add(values, size, group.weight);
      blocks.add(means, grid, group.weight);
      if (rendering.groups_share_sequence()) sequence.add(luminance_of(values), group.weight);
      weight += group.weight;
      most.resize(means.size() / channels);
      for (size_t b = 0; b < most.size(); ++b)
        most[b] = std::max(most[b], group.weight * means[channels * b + 3]);
    }
    blocks.remaining = sequence.remaining(size, ErrorEstimate::block_size);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) pixels.remaining.push_back(blocks.remaining[block(x, y)]);
  }
  int count() const { return pixels.spread.count(); }
  /// The block of a pixel.
  size_t block(int x, int y) const {
    constexpr int n = ErrorEstimate::block_size;
    return size_t(y / n) * grid.x + x / n;
  }

  Vec2i size{0}, grid{0};
  Groups pixels, blocks;
  double weight = 0;
  std::vector<double> most;  ///< Per block: most light of one group, times its weight.
};

double mean_luminance(const std::vector<float>& values) {
  double sum = 0;
  for (size_t i = 3; i < values.size(); i += channels) sum += values[i];
  return channels * sum / static_cast<double>(values.size());
}

/// Mean and squared standard error of the sum of several independent sets of groups.
class Total {
 public:
  explicit Total(const std::vector<const Groups*>& parts) {
    for (const Groups* part : parts) {
      add_mean(part->spread);
      add_variance(*part);
      brightness_.push_back(&part->brightness);
    }
  }
  /// Replaces the errors by those of other groups.
  void take_errors(const std::vector<const Groups*>& parts) {
    variance_.clear();
    for (const Groups* part : parts) add_variance(*part);
  }
  void add_error(const std::vector<float>& errors) {
    for (size_t i = 0; i < errors.size(); ++i) variance_[i] += errors[i] * errors[i];
  }

  const std::vector<float>& mean() const { return mean_; }
  Image error(const Vec2i& size) const {
    Image image(size.x, size.y, 3);
    for (size_t i = 0; i < image.data.size(); ++i)
      image.data[i] = std::sqrt(variance_[i / 3 * channels + i % 3]);
    return image;
  }

  RelativeError relative() const {
    const double floor = sqr(dark * mean_luminance(mean_));
    if (!(floor > 0)) return {};  // no light was found yet
    const std::vector<float> known = known_brightness(brightness_);
    double sum = 0, sum_of_squares = 0;
    for (size_t p = 0; p < known.size(); ++p) {
      const size_t i = channels * p + 3;
      const double brightness = std::max(double{known[p]}, least_of_seen * mean_[i]);
      const double term = variance_[i] / (sqr(brightness) + floor);
      sum += term;
      sum_of_squares += sqr(term);
    }
    return {std::sqrt(sum / static_cast<double>(known.size())),
            sum > 0 ? sqr(sum) / sum_of_squares : static_cast<double>(known.size())};
  }

 private:
  void add_mean(const Spread& spread) {
    mean_.resize(spread.size());
    for (size_t i = 0; i < mean_.size(); ++i) mean_[i] += spread.mean()[i];
  }
  void add_variance(const Groups& part) {
    variance_.resize(part.spread.size());
    for (size_t i = 0; i < variance_.size(); ++i)
      variance_[i] += static_cast<float>(part.remaining[i / channels] * part.spread.variance(i));
  }

  std::vector<float> mean_, variance_;
  std::vector<const BrightnessPyramid*> brightness_;
};

/// The groups of a rendering and of its parts, or how they differ from those of another one.
std::vector<GroupsOfRendering> all_groups(const ImageOf& image,
                                          const std::optional<ImageOf>& before = std::nullopt) {
  const auto part = [](const ImageOf& of, size_t i) {
    return ImageOf{of.rendering->parts()[i], of.layer, of.factor};
  };
  std::vector<GroupsOfRendering> all;
  all.emplace_back(*image.rendering, image.layer, before);
  for (size_t i = 0; i < image.rendering->parts().size(); ++i)
    all.emplace_back(*part(image, i).rendering, image.layer,
                     before ? std::optional(part(*before, i)) : std::nullopt);
  return all;
}

std::vector<const Groups*> pixels_of(const std::vector<GroupsOfRendering>& all) {
  std::vector<const Groups*> pixels;
  for (const GroupsOfRendering& part : all) pixels.push_back(&part.pixels);
  return pixels;
}

bool are_known(const std::vector<GroupsOfRendering>& all) {
  return std::all_of(all.begin(), all.end(), [](const auto& part) { return part.count() >= 2; });
}

std::vector<Disagreement> disagreements(const GroupsOfRendering& groups, const Total& blocks) {
  if (groups.count() < fewest_groups) return {};
  const double least = dark * mean_luminance(blocks.mean());
  std::vector<std::pair<float, Disagreement>> found;
  for (size_t b = 0; b < groups.most.size(); ++b) {
    const float light = blocks.mean()[channels * b + 3];
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

void count_pixels(const Image& image, ErrorEstimate& estimate) {
  for (size_t i = 0; i < image.data.size(); i += 3) {
    const auto [least, most] = std::minmax_element(&image.data[i], &image.data[i] + 3);
    estimate.negative_pixels += *least < 0;
    estimate.lit_pixels += *most > 0;
  }
}

}  // namespace

ErrorEstimate estimate_error(const Rendering& rendering, int layer) {
  const std::vector<GroupsOfRendering> all = all_groups({&rendering, layer});
  const GroupsOfRendering& groups = all[0];
  ErrorEstimate estimate;
  count_pixels(rendering.image(layer), estimate);
  estimate.groups = groups.count();
  if (!are_known(all)) return estimate;
  std::vector<const Groups*> parts_of_blocks;
  for (const GroupsOfRendering& part : all) parts_of_blocks.push_back(&part.blocks);
  Total pixels(pixels_of(all)), blocks(parts_of_blocks);
  if (const Image common = rendering.common_error(layer); !common.empty()) {
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

RelativeError error_of_change(const ImageOf& before, const ImageOf& after) {
  const std::vector<GroupsOfRendering> seen = all_groups(after),
                                       changes = all_groups(after, before);
  if (!are_known(changes)) return {};
  Total pixels(pixels_of(seen));
  pixels.take_errors(pixels_of(changes));
  for (const ImageOf& one : {before, after})
    if (Image common = one.rendering->common_error(one.layer); !common.empty()) {
      for (float& error : common.data) error *= one.factor;
      pixels.add_error(with_luminance(common));
    }
  return pixels.relative();
}

}  // namespace mlt
