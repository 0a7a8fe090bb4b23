// The independent samples of a Metropolis render: each path that they find is added to the image
// with its weight w1 (ClampingWeights), or may be where a chain starts.
#pragma once

#include "primary/primary_step.h"
#include "rendering/estimator_taker.h"
#include "rendering/metropolis_algorithm.h"

namespace mlt {

/// Where chains have a target of paths: T / p and T / P of each path.
class PathTargeting {
 public:
  PathTargeting(const PathTarget& target, double own_scale)
      : target_(&target), unit_(radiance_scale(target.scene()) / own_scale) {}

  template <class Found>
  void add(FoundLight light, Found&& found) {
    if (light.own_pixel) light.rgb /= unit_;
    if (is_black(light.rgb)) return;
    light.weight = target_->of(light.rgb, light.raster, light.certainty);
    light.target_over_density = light.weight * light.over_density;
    found(light);
  }
  template <class Found>
  void finish(Found&&) {}

 private:
  const PathTarget* target_;
  double unit_;  ///< What the estimator's light is divided by, to be a contribution to the image.
};

/// How pssmlt weights the states that its steps record. The proposals of large steps are
/// independent samples, with the density 1 of the numbers, and all are recorded. A step of a chain
/// records states with the density T / b, and p_large times others with the density 1; weighted as
/// samples of both (Kelemen et al. 2002, sec. 4.4), a state counts rgb / (T + p_large b). Any fixed
/// number in the place of b is right: it is that of the pilot.
struct LargeStepWeights {
  double share = 0;  ///< p_large times that number.

  double denominator(double target) const { return target + share; }
};

/// Where the target is that of all paths of a sample together, as for pssmlt.
class SampleTargeting {
 public:
  SampleTargeting(const Scene& scene, double own_scale, const LargeStepWeights& large_steps)
      : unit_(radiance_scale(scene) / own_scale), large_steps_(large_steps) {}

  template <class Found>
  void add(const FoundLight& light, Found&&) {
    state_.add(light, unit_);
  }
  template <class Found>
  void finish(Found&& found) {
    state_.find_target();
    for (const ImageLight& one : state_.light)
      found(FoundLight{one, 1, 0, 0, target_luminance(one.rgb),
                       large_steps_.denominator(state_.target)});
    state_.light.clear();
  }

 private:
  double unit_;  ///< See PathTargeting.
  LargeStepWeights large_steps_;
  PrimaryState state_;
};

/// Adds samples to the image with their weights w1. `Targeting` sets T / p and T / P of their
/// light.
template <class Targeting>
class ClampedSum {
 public:
  ClampedSum(const Scene& scene, const ClampingWeights& weights, Targeting targeting)
      : scale_(radiance_scale(scene)), weights_(weights), targeting_(std::move(targeting)) {}

  /// One sample.
  class Sample {
   public:
    Sample(ClampedSum& of, const Vec2& raster, SampleSink& sink)
        : of_(&of), sink_(&sink), light_(raster, of.scale_, sink) {}
    void add(const FoundLight& light) {
      of_->targeting_.add(light, [&](const FoundLight& found) { show(found); });
    }
    void finish() {
      of_->targeting_.finish([&](const FoundLight& found) { show(found); });
      light_.finish();
      sink_->add_sums(sum_.brightness, sum_.of_chains);
    }

   private:
    void show(const FoundLight& found) {
      if (!found.valid()) return sink_->count_invalid();
      light_.add(found, found.rgb * of_->weights_.of_sample(found.target_over_density));
      sum_.add(found, of_->weights_);
    }

    ClampedSum* of_;
    SampleSink* sink_;
    SampleLight light_;
    SampleWeights sum_;
  };

 private:
  double scale_;
  ClampingWeights weights_;
  Targeting targeting_;
};

template <class Estimator, class Targeting, class Wave = NoWave>
std::unique_ptr<SampleTaker> take_beside_chains(const Scene& scene, Estimator estimator,
                                                Targeting targeting, const ClampingWeights& weights,
                                                std::unique_ptr<Wave> wave = nullptr) {
  using Sum = ClampedSum<Targeting>;
  return std::make_unique<EstimatorTaker<Estimator, Sum, Wave>>(
      std::move(estimator), Sum(scene, weights, std::move(targeting)), std::move(wave));
}

/// Takes samples one after the other: for the pilot, and for the starts of chains.
template <class Estimator, class Targeting>
class EstimatorSource : public MetropolisAlgorithm::Source {
 public:
  EstimatorSource(Estimator estimator, Targeting targeting, double cost_of_ray)
      : estimator_(std::move(estimator)),
        targeting_(std::move(targeting)),
        cost_of_ray_(cost_of_ray) {}

  const std::vector<FoundLight>& sample(const Vec2& raster, PixelSampler& sampler) override {
    return drawn(raster, sampler);
  }
  const std::vector<FoundLight>& sample(const Vec2& raster, RandomSampler& sampler) override {
    return drawn(raster, sampler);
  }
  const RayCounts& rays() const override { return rays_; }
  double cost_of_ray() const override { return cost_of_ray_; }

 private:
  template <class Sampler>
  const std::vector<FoundLight>& drawn(const Vec2& raster, Sampler& sampler) {
    found_.clear();
    const auto take = [&](const FoundLight& light) { found_.push_back(light); };
    estimator_(raster, sampler, rays_,
               [&](const FoundLight& light) { targeting_.add(light, take); });
    targeting_.finish(take);
    return found_;
  }

  Estimator estimator_;
  Targeting targeting_;
  double cost_of_ray_;
  RayCounts rays_;
  std::vector<FoundLight> found_;
};

template <class Estimator, class Targeting>
std::unique_ptr<MetropolisAlgorithm::Source> make_source(Estimator estimator, Targeting targeting,
                                                         double cost_of_ray = 1) {
  return std::make_unique<EstimatorSource<Estimator, Targeting>>(std::move(estimator),
                                                                 std::move(targeting), cost_of_ray);
}

}  // namespace mlt
