// The independent samples beside chains of light paths, where they are those of path tracing.
#pragma once

#include "path/inspect.h"
#include "rendering/metropolis_algorithm.h"
#include "rendering/wave_taker.h"

namespace mlt {

/// Finds the paths of one sample after the other: for the pilot.
class TracedSource : public SourceOf<TracedSource> {
 public:
  explicit TracedSource(const PathTarget& target)
      : target_(&target), scale_(radiance_scale(target.scene())) {}

  template <class Sampler>
  void draw(const Vec2& raster, Sampler& sampler, std::vector<FoundLight>& found) {
    const Scene& scene = target_->scene();
    CameraWalk walk(leave_lens(scene.camera(), raster, sampler).ray);
    walk.mis = MisExponent(Heuristic::balance);
    walk.certainty = 1;
    trace_path(scene, target_->rules(), walk, sampler, rays_, Finder(*this, raster, found));
  }
  const RayCounts& rays() const override { return rays_; }
  /// Cost of a ray of TracedTaker: .29 to .46 in bench_ray_cost, less where all is Lambertian.
  double cost_of_ray() const override { return 0.35; }

 private:
  struct Finder : IgnorePaths {
    Finder(const TracedSource& of, const Vec2& at, std::vector<FoundLight>& to)
        : source(of), raster(at), found(to) {}
    void find(const CameraWalk& walk, const Color& radiance, double certainty) {
      const Color seen = radiance / source.scale_;
      const double weight = source.target_->of(seen, raster, certainty);
      if (target_luminance(seen) > 0)
        found.push_back({raster, seen, weight, weight * walk.survival, true});
    }
    const TracedSource& source;
    Vec2 raster;
    std::vector<FoundLight>& found;
  };

  const PathTarget* target_;
  double scale_;
  RayCounts rays_;
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
    walk.mis = MisExponent(Heuristic::balance);
    walk.chain_factor = chain_factor(raster);
    walk.certainty = 1;
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
