// The independent samples beside chains of light paths: those of bidirectional path tracing.
#pragma once

#include "mutation/path_seeds.h"
#include "rendering/metropolis_algorithm.h"

namespace mlt {

class PathSource : public SourceOf<PathSource> {
 public:
  explicit PathSource(const PathTarget& target) : seeds_(target) {}

  template <class Sampler>
  void draw(const Vec2& raster, Sampler& sampler, std::vector<FoundLight>& found) {
    seeds_.draw(raster, sampler, [&](const Connection& c, double weight) {
      found.push_back(
          {c.raster, c.contribution * c.weight, weight, weight / c.weight * c.own_share, c.t >= 2});
    });
  }
  const RayCounts& rays() const override { return seeds_.rays(); }
  /// Cost of a ray, measured in bench_ray_cost: .75 to .93.
  double cost_of_ray() const override { return 0.8; }

 private:
  PathSeeds seeds_;
};

}  // namespace mlt
