// Samples of path tracing, traced side by side.
#pragma once

#include "integrator/sampled_rendering.h"
#include "path/inspect.h"
#include "path/wavefront.h"

namespace mlt {

class WaveTaker : public SampleTaker {
 public:
  WaveTaker(const Scene& scene, const PathRules& rules, Heuristic heuristic)
      : scene_(&scene), rules_(rules), wave_(scene, rules, heuristic) {}

  void finish(SampleSink& sink, RayCounts& rays) override {
    wave_.trace(rays);
    for (size_t i = 0; i < wave_.size(); ++i) add(rasters_[i], wave_[i], sink);
    wave_.clear();
    rasters_.clear();
  }

 protected:
  const Scene& scene() const { return *scene_; }
  const PathRules& rules() const { return rules_; }

  /// Begins a path; for `chain_factor` see CameraWalk.
  void begin(const Vec2& raster, const Ray& ray, const PixelSampler& sampler, double chain_factor,
             SampleSink& sink, RayCounts& rays) {
    wave_.add(ray, sampler, chain_factor);
    rasters_.push_back(raster);
    if (wave_.full()) finish(sink, rays);
  }

 private:
  /// What has come of one of them.
  virtual void add(const Vec2& raster, const CameraWalk& walk, SampleSink& sink) {
    sink.add(raster, walk.radiance);
  }

  const Scene* scene_;
  PathRules rules_;
  Wavefront wave_;
  std::vector<Vec2> rasters_;  ///< Of the paths in it.
};

}  // namespace mlt
