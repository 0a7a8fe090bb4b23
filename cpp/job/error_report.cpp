// What a render tells about its error: layers of the image, statistics and warnings.
#include "job/error_estimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mlt {
namespace {

/// Where fewer pixels carry a larger error, it is not to be relied on. Of renders of random scenes
/// by mlt this and its uncertain_level find most whose error is not .8 to 1.25 times what they
/// claim (docs/error-calibration.md).
constexpr double few_pixels = 35, large_error = 0.12;

}  // namespace

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
  stats.error = estimate.relative.value;
  stats.block_error = estimate.relative_blocks.value;
  stats.pixels_carrying_error = estimate.relative.carrying;
  if (estimate.relative.carrying < few_pixels && estimate.relative.value > large_error)
    stats.warnings.push_back(fmt::format(
        "the error of {:.2g} is that of {:.0f} pixel{}: some light is found so rarely that the "
        "true error may be several times larger; render for longer, or look whether another "
        "integrator finds this light more easily",
        estimate.relative.value, std::ceil(estimate.relative.carrying),
        estimate.relative.carrying > 1 ? "s" : ""));
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
