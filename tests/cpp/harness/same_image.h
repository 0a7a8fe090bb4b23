// Do two renderings converge to the same image? Each is made R times with different seeds. Per
// block of pixels and channel, at three scales (the whole image, 4 x 3 blocks, 16 x 12 blocks),
// Welch's t-test compares the means. Each scale has a third of the level, with Holm's correction
// inside, so the chance of even one false rejection is below alpha.
//
// Noise must not pass for agreement: the harness also computes the difference that it would have
// found with 90 % power. From a pilot it learns how many samples that takes, and it fails if they
// are too many. A rejection is repeated with new seeds and four times the samples: bugs get worse,
// chance goes away.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/statistics.h"
#include "image/image.h"

namespace mlt::test {

/// Renders with this seed and this many times the usual samples.
using Render = std::function<Image(uint64_t seed, double effort)>;

/// A way to make an image, or a known one.
struct Side {
  std::string name;
  Render render;
  std::optional<Image> known = {};
};

struct SameImageSettings {
  int runs = 16;
  double alpha = 1e-3;
  double whole = 0.01;  ///< The difference of a whole image that must not stay unseen, relative.
  double block = 0.05;  ///< The same for the median of the 4 x 3 blocks.
  double max_effort = 100;  ///< How many times the usual samples may be needed for that.
  uint64_t seed = 1;
};

struct SameImage {
  bool same = false, powerful = false;
  std::string text;  ///< What was found, in one line.
  explicit operator bool() const { return same && powerful; }
};

/// The means of the blocks of an image at one scale, or of many images.
class BlockMeans {
 public:
  BlockMeans(int nx, int ny) : nx_(nx), ny_(ny) {}

  void add(const Image& image) {
    const int nx = std::min(nx_, image.width), ny = std::min(ny_, image.height);
    moments_.resize(size_t{3} * nx * ny);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        for (int c = 0; c < 3; ++c)
          moments_[3 * (size_t(j) * nx + i) + c].add(
              mean(image, image.width * i / nx, image.width * (i + 1) / nx, image.height * j / ny,
                   image.height * (j + 1) / ny, c));
  }
  /// One for each block and channel.
  const std::vector<Moments>& moments() const { return moments_; }

 private:
  static double mean(const Image& image, int x0, int x1, int y0, int y1, int c) {
    double sum = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) sum += image.at(x, y, c);
    return sum / ((x1 - x0) * (y1 - y0));
  }

  int nx_, ny_;
  std::vector<Moments> moments_;
};

class SameImageTest {
 public:
  SameImageTest(Side a, Side b, const SameImageSettings& settings)
      : sides_{std::move(a), std::move(b)}, settings_(settings) {}

  SameImage run() {
    // Rejected or not, the number of samples follows from the variances alone.
    run_all();
    while (!powerful() && raise_efforts()) {
    }
    SameImage result{least_p() > settings_.alpha, powerful(), describe()};
    if (result.powerful && !result.same) {
      for (double& effort : efforts_) effort *= 4;
      run_all();
      result = {least_p() > settings_.alpha, powerful(), result.text + "; again: " + describe()};
    }
    return result;
  }

 private:
  using Scales = std::array<BlockMeans, 3>;

  void run_all() {
    ++round_;
    for (int side = 0; side < 2; ++side) run_side(side);
  }

  void run_side(int side) {
    Scales scales{BlockMeans(1, 1), BlockMeans(4, 3), BlockMeans(16, 12)};
    const auto add = [&](const Image& image) {
      for (BlockMeans& scale : scales) scale.add(image);
    };
    if (sides_[side].known) {
      add(*sides_[side].known);
    } else {
      for (int r = 0; r < settings_.runs; ++r)
        add(sides_[side].render(((settings_.seed * 1000 + round_) * 2 + side) * 1000 + r,
                                efforts_[side]));
    }
    means_[side] = scales;
  }

  TTest test(int scale, size_t i) const {
    const Moments &a = moments(0, scale)[i], &b = moments(1, scale)[i];
    TTest test = sides_[1].known ? one_sample_t_test(a, b.mean()) : welch_t_test(a, b);
    // Images are made of floats: a constant one may be off by their rounding.
    if (std::abs(test.difference) <= 1e-6 * std::abs(b.mean())) test.p_value = 1;
    return test;
  }
  const std::vector<Moments>& moments(int side, int scale) const {
    return (*means_[side])[scale].moments();
  }

  /// The least p-value, corrected for how many there are.
  double least_p() const {
    double least = 1;
    for (int scale = 0; scale < 3; ++scale) {
      std::vector<double> p;
      for (size_t i = 0; i < moments(0, scale).size(); ++i) p.push_back(test(scale, i).p_value);
      const std::vector<double> adjusted = holm_adjusted(p);
      least = std::min(least, 3 * *std::min_element(adjusted.begin(), adjusted.end()));
    }
    return least;
  }

  /// The relative difference that would have been found, for each block and channel that is lit.
  std::vector<double> detectable(int scale) const {
    const size_t n = moments(0, scale).size();
    std::vector<double> found;
    for (size_t i = 0; i < n; ++i) {
      const double mean = std::max(moments(0, scale)[i].mean(), moments(1, scale)[i].mean());
      if (mean > 0) found.push_back(test(scale, i).detectable(settings_.alpha / (3.0 * n)) / mean);
    }
    std::sort(found.begin(), found.end());
    if (found.empty()) found.push_back(1);  // a black image shows nothing
    return found;
  }
  double detectable_whole() const { return detectable(0).back(); }
  double detectable_block() const {
    const std::vector<double> found = detectable(1);
    return found[found.size() / 2];
  }
  bool powerful() const {
    return detectable_whole() < settings_.whole && detectable_block() < settings_.block;
  }

  /// More samples, and more where there is more noise; false if it would take too many, or if the
  /// images are no numbers.
  bool raise_efforts() {
    const double lack =
        sqr(std::max(detectable_whole() / settings_.whole, detectable_block() / settings_.block));
    if (!(lack >= 1)) return false;
    // The efforts with the least sum for this sum of variances (Neyman's allocation), with a margin
    // for chance.
    const double noise[2] = {noise_of(0), noise_of(1)};
    const double root = std::sqrt(noise[0] * efforts_[0]) + std::sqrt(noise[1] * efforts_[1]);
    for (int side = 0; side < 2; ++side) {
      const double share = root * std::sqrt(noise[side] / efforts_[side]) / (noise[0] + noise[1]);
      efforts_[side] *= std::max(1.0, 1.4 * lack * share);
    }
    if (std::max(efforts_[0], efforts_[1]) > settings_.max_effort) return false;
    run_all();
    return true;
  }
  /// Variance of a side, relative, in the median of the 4 x 3 blocks.
  double noise_of(int side) const {
    std::vector<double> noise;
    for (const Moments& m : moments(side, 1))
      if (m.mean() > 0) noise.push_back(m.variance_of_mean() / sqr(m.mean()));
    if (noise.empty()) return 1;
    std::sort(noise.begin(), noise.end());
    return noise[noise.size() / 2] + 1e-30;
  }
  static double sqr(double x) { return x * x; }

  std::string describe() const {
    char text[300];
    const Moments &a = moments(0, 0)[1], &b = moments(1, 0)[1];
    std::snprintf(
        text, sizeof text,
        "%s %.5g and %s %.5g (green), p = %.2g, visible from %.2f %% (whole) and %.1f %% (block), "
        "efforts %.3g and %.3g",
        sides_[0].name.c_str(), a.mean(), sides_[1].name.c_str(), b.mean(), least_p(),
        100 * detectable_whole(), 100 * detectable_block(), efforts_[0], efforts_[1]);
    return text;
  }

  std::array<Side, 2> sides_;
  SameImageSettings settings_;
  std::array<double, 2> efforts_{1, 1};
  std::array<std::optional<Scales>, 2> means_;
  uint64_t round_ = 0;
};

/// `b` may be a known image; `a` may not. Says what was found, since how much would have been seen
/// is worth knowing of a test that passes, too.
inline SameImage same_image(const Side& a, const Side& b, const SameImageSettings& settings = {}) {
  const SameImage found = SameImageTest(a, b, settings).run();
  std::puts(found.text.c_str());
  std::fflush(stdout);
  return found;
}

}  // namespace mlt::test
