// The independent samples beside chains of light paths: those of bidirectional path tracing.
#pragma once

#include "mutation/path_seeds.h"
#include "rendering/metropolis_algorithm.h"

namespace mlt {

class PathSource : public MetropolisAlgorithm::Source {
 public:
  explicit PathSource(const PathTarget& target) : seeds_(target) {}

  const std::vector<FoundLight>& sample(const Vec2& raster, PixelSampler& sampler) override {
    return draw(raster, sampler);
  }
  const std::vector<FoundLight>& sample(const Vec2& raster, RandomSampler& sampler) override {
    return draw(raster, sampler);
  }
  const RayCounts& rays() const override { return seeds_.rays(); }
  /// Cost of a ray, measured in bench_ray_cost: .75 to .93.
  double cost_of_ray() const override { return 0.8; }

 private:
  template <class Sampler>
  const std::vector<FoundLight>& draw(const Vec2& raster, Sampler& sampler) {
    found_.clear();
    seeds_.draw(raster, sampler, [&](const Connection& c, double weight) {
      found_.push_back(
          {c.raster, c.contribution * c.weight, weight, weight / c.weight * c.own_share, c.t >= 2});
    });
    return found_;
  }

  PathSeeds seeds_;
  std::vector<FoundLight> found_;
};

}  // namespace mlt
