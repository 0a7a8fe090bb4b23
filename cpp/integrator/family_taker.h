// The independent samples of a Metropolis render: each path that they find goes to the image with its
// weight w1 (FamilyWeights).
#pragma once

#include "integrator/family_weights.h"
#include "integrator/metropolis_algorithm.h"
#include "integrator/sampled_rendering.h"
#include "path/inspect.h"

namespace mlt {

class FamilyTaker : public SampleTaker {
 public:
  FamilyTaker(const MetropolisAlgorithm& algorithm, const FamilyWeights& weights)
      : scale_(radiance_scale(algorithm.scene())),
        source_(algorithm.sample_source()),
        weights_(weights) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    Color own_pixel(0);
    SampleWeights sum;
    for (const FoundLight& found : source_->sample(raster, sampler)) {
      if (!found.valid()) {
        sink.count_invalid();
        continue;
      }
      const Color weighted = found.rgb * weights_.of_sample(found.target_over_density);
      if (found.own_pixel)
        own_pixel += weighted;
      else
        sink.splat(found.raster, weighted);
      sum.add(found, weights_);
    }
    sink.add(raster, own_pixel * scale_);
    sink.add_sums(sum.brightness, sum.of_chains);
    rays = source_->rays();  // a taker counts the rays of all its samples
  }

 private:
  double scale_;
  std::unique_ptr<MetropolisAlgorithm::Source> source_;
  FamilyWeights weights_;
};

}  // namespace mlt
