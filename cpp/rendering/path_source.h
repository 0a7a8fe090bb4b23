// The independent samples beside chains of light paths, where they are those of bidirectional path
// tracing.
#pragma once

#include "mutation/path_seeds.h"
#include "rendering/bidirectional_taker.h"
#include "rendering/family_taker.h"

namespace mlt {

/// How samples that go to the image are taken. Waves know the balance heuristic alone: with it f/P
/// is the weighted f / p of a path, without roulette.
struct PathSampling {
  explicit PathSampling(const PathTarget& target) : settings(PathSeeds::settings(target)) {
    settings.heuristic = Heuristic::balance;
    in_waves = BidirectionalWave::supports(target.scene(), settings);
    if (!in_waves) settings.heuristic = PathSeeds::settings(target).heuristic;
  }

  BidirectionalSettings settings;
  bool in_waves;
};

class PathSource : public SourceOf<PathSource> {
 public:
  explicit PathSource(const PathTarget& target) : seeds_(target) {}
  /// One after the other, what PathSampleTaker takes: for the pilot.
  PathSource(const PathTarget& target, const PathSampling& sampling)
      : seeds_(target, sampling.settings), in_waves_(sampling.in_waves) {}

  template <class Sampler>
  void draw(const Vec2& raster, Sampler& sampler, std::vector<FoundLight>& found) {
    seeds_.draw(raster, sampler, [&](const Connection& c, double weight) {
      found.push_back(
          {c.raster, c.contribution * c.weight, weight, weight / c.weight * c.own_share, c.t >= 2});
    });
  }
  const RayCounts& rays() const override { return seeds_.rays(); }
  RayCounts take_rays() { return seeds_.take_rays(); }
  /// Cost of a ray, measured in bench_ray_cost: .75 to .93, in waves .3 to .4.
  double cost_of_ray() const override { return in_waves_ ? 0.35 : 0.8; }

 private:
  PathSeeds seeds_;
  bool in_waves_ = false;
};

/// Adds the samples to the image with the weights w1 (FamilyWeights).
class PathSampleTaker : public BidirectionalTaker {
 public:
  PathSampleTaker(const PathTarget& target, const PathSampling& sampling,
                  const FamilyWeights& weights)
      : BidirectionalTaker(target.scene(), sampling.settings, sampling.in_waves),
        target_(&target),
        source_(target, sampling),
        weighting_(target.scene(), weights) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    found_.clear();
    source_.draw(raster, sampler, found_);
    weighting_.show(raster, found_, sink);
    rays += source_.take_rays();
  }

 private:
  void show(const BidirectionalWave& wave, int i, SampleSink& sink) override {
    found_.clear();
    wave.show_lights(i, [&](const BidirectionalWave::Light& light) {
      const double certainty = light.edges == 1 ? 1 : 0;  // all surfaces are Lambertian
      const double weight = target_->of(light.weighted, light.raster, certainty);
      found_.push_back(
          {light.raster, light.weighted, weight, weight * light.survival, light.own_pixel});
    });
    weighting_.show(wave.raster(i), found_, sink);
  }

  const PathTarget* target_;
  PathSource source_;
  FamilyWeighting weighting_;
  std::vector<FoundLight> found_;
};

}  // namespace mlt
