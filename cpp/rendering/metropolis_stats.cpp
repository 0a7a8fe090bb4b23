// The statistics of a render of chains and samples.
#include "rendering/hidden_lights.h"
#include "rendering/metropolis_rendering.h"

#include <fmt/format.h>

#include <cmath>

namespace mlt {
namespace {

/// From this uncertainty of the brightness on the error of an image is not to be relied on.
constexpr double uncertain_level = 0.055;

/// From this share on it is told that light of waiting tours is missing.
constexpr double much_waiting = 0.02;

}  // namespace

/// Sums the statistics of all chains; `stuck` becomes the one with the longest run of rejections.
ChainStats MetropolisRendering::sum_of_stats(StuckChain& stuck) const {
  ChainStats sum;
  sum.rows.resize(algorithm_->rows().size());
  sum.rays = bootstrap_rays_;
  uint64_t number = 0;
  for (const auto& team : teams_) {
    const std::lock_guard lock(team->mutex);
    for (const auto& chain : team->chains) {
      const ChainStats& s = chain->stats();
      for (size_t r = 0; r < sum.rows.size(); ++r) sum.rows[r] += s.rows[r];
      sum.rays += s.rays;
      sum.invalid += s.invalid;
      sum.tours += s.tours;
      sum.longest_tour = std::max(sum.longest_tour, s.longest_tour);
      if (s.longest.rejections > stuck.rejections)
        stuck = {number, s.longest.rejections, s.longest.raster.x, s.longest.raster.y,
                 s.longest.signature};
      ++number;
    }
  }
  return sum;
}

/// Adds the mean brightness, its error and the samples that it was estimated from.
void MetropolisRendering::add_level(Stats& stats) const {
  SampleSums bootstrap;
  for (const GroupProgress& group : progress()) bootstrap += group.bootstrap;
  Estimate b = estimate(bootstrap.brightness);
  WeightClasses classes = bootstrap.classes;
  if (samples_) {
    b = pooled(b, samples_->mean_brightness());
    classes += samples_->classes();
  }
  stats.b = b.mean;
  stats.b_error = std::sqrt(b.variance);
  stats.independent_share = allocation_.share;
  if (samples_) stats.independent = algorithm_->samples_name();
  stats.independent_samples = b.count;
  stats.samples_carrying_half = classes.carrying_half();
  if (b.mean > 0) {
    const GroupEstimator groups = group_estimator();
    stats.level_error = std::hypot(stats.b_error, groups.missing()) / b.mean;
    stats.tours_waiting = groups.waiting() / b.mean;
  }
  if (stats.level_error > uncertain_level)
    stats.warnings.push_back(fmt::format(
        "the image may be {:.0f} % too bright or too dark: some light is found so rarely that its "
        "amount is not known yet; render for longer",
        100 * stats.level_error));
  if (stats.tours_waiting > much_waiting)
    stats.warnings.push_back(fmt::format(
        "about {:.0f} % of the light is missing yet: it was found by so few samples that it would "
        "be sparks; it comes as the render goes on",
        100 * stats.tours_waiting));
  if (!allocation_.in_time)
    stats.warnings.push_back(
        "the time was too short to prepare chains: the image is one of independent samples");
  else if (allocation_.share == 1 && settings_.independent_share != 1)
    stats.warnings.push_back(
        "no light was found for chains to start from; give more luminance_samples, or check that "
        "light can reach the camera");
}

void MetropolisRendering::add_stats(Stats& stats) const {
  if (samples_) samples_->add_stats(stats);
  if (settings_.only_camera_walks) warn_of_hidden_lights(scene(), stats);
  StuckChain stuck;
  const ChainStats sum = sum_of_stats(stuck);
  if (stuck.rejections > 0) stats.stuck = {stuck};
  stats.invalid_samples += sum.invalid;
  stats.rays_intersect += sum.rays.intersect;
  stats.rays_occluded += sum.rays.occluded;
  stats.tours = sum.tours;
  stats.longest_tour = sum.longest_tour;
  add_level(stats);
  add_rows(algorithm_->rows(), sum.rows, stats);
  if (film_.saturated() > 0)
    stats.warnings.push_back(
        "the film's fixed-point range was exceeded; the brightest pixels are wrong");
}

}  // namespace mlt
