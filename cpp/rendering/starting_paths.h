// The samples of bidirectional path tracing that tours start from, before a render: what there is
// for tours to start from, and how bright a sample of the image makes it.
#pragma once

#include "mutation/path_seeds.h"
#include "path/found_light.h"

#include <vector>

namespace mlt {

/// A path from which tours may start.
struct Start {
  double energy;  ///< T / S, which is T / P of samples by all techniques.
  double traced;  ///< T / P of samples of path tracing.
  double count;   ///< How many such paths it stands for.
};

class StartingPaths {
 public:
  explicit StartingPaths(const PathTarget& target) : target_(&target), seeds_(target) {}

  /// Draws a sample, and returns its light. Of paths with a weight T / p below the mean of all up
  /// to now only some are kept as starts, which then count for others.
  const std::vector<FoundLight>& sample(const Vec2& raster, PixelSampler& sampler) {
    lights_.clear();
    const double level = paths_ > 0 ? sum_ / paths_ : 0;
    seeds_.draw(raster, sampler, [&](const Connection& c, double weight) {
      FoundLight light{{c.raster, c.contribution * c.weight, c.t >= 2}, 1, c.certainty};
      light.weight = weight;
      light.target_over_density = weight / c.weight * c.own_share;
      if (light.valid()) lights_.push_back(light);
      sum_ += weight;
      ++paths_;
      if (!(light.target_over_density > 0) || !(choice_.next() * level < weight)) return;
      seeds_.assemble(c, x_);
      if (!(x_.target > 0)) return;
      const double energy = light.target_over_density,
                   traced = x_.target / target_->path_tracing_density(x_);
      starts_.push_back({energy, traced, std::max(weight, level) / energy});
    });
    return lights_;
  }
  const std::vector<Start>& starts() const { return starts_; }
  const RayCounts& rays() const { return seeds_.rays(); }

 private:
  const PathTarget* target_;
  PathSeeds seeds_;
  PathState x_;
  Rng choice_{0, Purpose::allocation, 0};
  double sum_ = 0;  ///< The sum of the weights of all paths.
  uint64_t paths_ = 0;
  std::vector<FoundLight> lights_;
  std::vector<Start> starts_;
};

}  // namespace mlt
