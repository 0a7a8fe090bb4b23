// The independent samples beside chains of light paths, where they are those of path tracing.
#pragma once

#include "path/inspect.h"
#include "rendering/metropolis_algorithm.h"
#include "rendering/wave_taker.h"

namespace mlt {

/// Returns each path that a sample finds, one sample after the other: for the pilot.
class TracedSource : public MetropolisAlgorithm::Source {
 public:
  explicit TracedSource(const PathTarget& target)
      : target_(&target), scale_(radiance_scale(target.scene())) {}

  const std::vector<FoundLight>& sample(const Vec2& raster, PixelSampler& sampler) override {
    return trace(raster, sampler);
  }
  const std::vector<FoundLight>& sample(const Vec2& raster, RandomSampler& sampler) override {
    return trace(raster, sampler);
  }
  const RayCounts& rays() const override { return rays_; }
  /// Cost of a ray of TracedTaker: .29 to .46 in bench_ray_cost, less where all is matte.
  double cost_of_ray() const override { return 0.35; }

 private:
  struct Finder : IgnorePaths {
    Finder(TracedSource& of, const Vec2& at) : source(of), raster(at) {}
    void find(const CameraWalk& walk, const Color& radiance, double certainty) {
      const Color rgb = radiance / source.scale_;
      const double weight = source.target_->of(rgb, raster, certainty);
      if (target_luminance(rgb) > 0)
        source.found_.push_back({raster, rgb, weight, weight * walk.survival, true});
    }
    TracedSource& source;
    Vec2 raster;
  };

  template <class Sampler>
  const std::vector<FoundLight>& trace(const Vec2& raster, Sampler& sampler) {
    found_.clear();
    const Scene& scene = target_->scene();
    CameraWalk walk(leave_lens(scene.camera(), raster, sampler).ray);
    walk.heuristic = Heuristic::balance;
    trace_path(scene, target_->rules(), walk, sampler, rays_, Finder(*this, raster));
    return found_;
  }

  const PathTarget* target_;
  double scale_;
  RayCounts rays_;
  std::vector<FoundLight> found_;
};

/// Traces samples side by side and adds them to the image with the weights w1 (FamilyWeights), for
/// the render. They do not estimate the brightness, since there may be light they cannot find.
class TracedTaker : public WaveTaker {
 public:
  TracedTaker(const PathTarget& target, const FamilyWeights& weights)
      : WaveTaker(target.scene(), target.rules(), Heuristic::balance),
        target_(&target),
        scale_(radiance_scale(target.scene())),
        threshold_(weights.threshold()) {}

  /// Traces one sample alone, for replaying it.
  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    CameraWalk walk(leave_lens(scene().camera(), raster, sampler).ray);
    walk.heuristic = Heuristic::balance;
    walk.chain_factor = chain_factor(raster);
    sink.add(raster, trace_path(scene(), rules(), walk, sampler, rays));
  }

 private:
  ChainFactor chain_factor(const Vec2& raster) const override {
    return {target_->factor(raster) / (scale_ * threshold_), target_->most_certain(raster)};
  }

  const PathTarget* target_;
  double scale_, threshold_;
};

}  // namespace mlt
