// The independent samples of pssmlt over path tracing, traced side by side.
#pragma once

#include "rendering/family_taker.h"
#include "rendering/large_step_weights.h"
#include "rendering/wave_taker.h"

namespace mlt {

class WalkTaker : public WaveTaker {
 public:
  WalkTaker(const Scene& scene, const PathRules& rules, const LargeStepWeights& large_steps,
            const FamilyWeights& weights)
      : WaveTaker(scene, rules, Heuristic::power),
        large_steps_(large_steps),
        weighting_(scene, weights),
        scale_(radiance_scale(scene)) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    const Ray ray = leave_lens(scene().camera(), raster, sampler).ray;
    show(raster, trace_path(scene(), rules(), ray, sampler, rays), sink);
  }

 private:
  void show(const Vec2& raster, const Color& radiance, SampleSink& sink) override {
    found_.clear();
    const ImageLight light{raster, radiance / scale_};
    if (!is_black(light.rgb))
      found_.push_back(large_steps_.found(light, target_luminance(light.rgb)));
    weighting_.show(raster, found_, sink);
  }

  LargeStepWeights large_steps_;
  FamilyWeighting weighting_;
  double scale_;
  std::vector<FoundLight> found_;
};

}  // namespace mlt
