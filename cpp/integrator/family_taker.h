// The independent samples of a Metropolis render: what they are believed goes to the image.
#pragma once

#include "integrator/family_weights.h"
#include "integrator/metropolis_algorithm.h"
#include "integrator/sampled_rendering.h"
#include "path/inspect.h"

namespace mlt {

class FamilyTaker : public SampleTaker {
 public:
  FamilyTaker(const Scene& scene, const MetropolisAlgorithm& algorithm,
              const FamilyWeights& weights)
      : scale_(radiance_scale(scene)), source_(algorithm.source()), weights_(weights) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    Color own_pixel(0);
    double brightness = 0, of_chains = 0;
    for (const FoundLight& found : source_->sample(raster, sampler)) {
      if (!found.valid()) {
        sink.count_invalid();
        continue;
      }
      const Color believed = found.rgb * weights_.of_sample(found.target_over_density);
      if (found.own_pixel)
        own_pixel += believed;
      else
        sink.splat(found.raster, believed);
      const double luminance = target_luminance(found.rgb);
      brightness += luminance;
      of_chains += luminance * weights_.of_chain(found.target_over_density);
    }
    sink.add(raster, own_pixel * scale_);
    sink.add_sums(brightness, of_chains);
    rays = source_->rays();  // a taker counts the rays of all its samples
  }

 private:
  double scale_;
  std::unique_ptr<MetropolisAlgorithm::Source> source_;
  FamilyWeights weights_;
};

}  // namespace mlt
