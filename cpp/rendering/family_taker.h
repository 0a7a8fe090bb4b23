// The independent samples of a Metropolis render: each path that they find is added to the image
// with its weight w1 (FamilyWeights).
#pragma once

#include "path/inspect.h"
#include "rendering/family_weights.h"
#include "rendering/metropolis_algorithm.h"
#include "rendering/sampled_rendering.h"

namespace mlt {

/// Adds all light that one sample has found to the image.
class FamilyWeighting {
 public:
  FamilyWeighting(const Scene& scene, const FamilyWeights& weights)
      : scale_(radiance_scale(scene)), weights_(weights) {}

  void show(const Vec2& raster, const std::vector<FoundLight>& all, SampleSink& sink) const {
    Color own_pixel(0);
    SampleWeights sum;
    for (const FoundLight& found : all) {
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
  }

 private:
  double scale_;
  FamilyWeights weights_;
};

class FamilyTaker : public SampleTaker {
 public:
  FamilyTaker(const MetropolisAlgorithm& algorithm, const FamilyWeights& weights)
      : source_(algorithm.sample_source()), weighting_(algorithm.scene(), weights) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    weighting_.show(raster, source_->sample(raster, sampler), sink);
    rays = source_->rays();  // a taker counts the rays of all its samples
  }

 private:
  std::unique_ptr<MetropolisAlgorithm::Source> source_;
  FamilyWeighting weighting_;
};

}  // namespace mlt
