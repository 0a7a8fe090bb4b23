// The estimators that pssmlt moves the random numbers of: path tracing, bidirectional path tracing,
// light tracing. Each returns the contributions f / p of the paths of one sample to the image, the
// importance over the density of raster positions included.
#pragma once

#include "path/bidirectional_sampler.h"
#include "path/path_tracer.h"
#include "primary/primary_step.h"

#include <vector>

namespace mlt {

class PathEstimator {
 public:
  PathEstimator(const Scene& scene, const PathRules& rules) : scene_(&scene), rules_(rules) {}

  template <class Sampler>
  void operator()(const Vec2& raster, Sampler& sampler, std::vector<ImageLight>& light,
                  RayCounts& rays) const {
    const Raster& image = scene_->camera().raster();
    const Ray ray = leave_lens(scene_->camera(), raster, sampler).ray;
    const Color radiance = trace_path(*scene_, rules_, ray, sampler, rays);
    if (!is_black(radiance))
      light.push_back({raster, radiance * (image.sampled_area() / image.pixels()), true});
  }

 private:
  const Scene* scene_;
  PathRules rules_;
};

/// An estimator with all techniques (s, t).
class BidirectionalEstimator {
 public:
  BidirectionalEstimator(const Scene& scene, const PathRules& rules) : paths_(scene, {rules}) {}

  template <class Sampler>
  void operator()(const Vec2& raster, Sampler& sampler, std::vector<ImageLight>& light,
                  RayCounts& rays) {
    paths_.sample(raster, sampler, rays);
    size_t own_pixel = no_light;  // light at the sample's own position is one entry
    paths_.connect_all(rays, [&](const Connection& c) {
      const Color rgb = c.contribution * c.weight;
      if (c.t >= 2 && own_pixel != no_light) {
        light[own_pixel].rgb += rgb;
        return;
      }
      if (c.t >= 2) own_pixel = light.size();
      light.push_back({c.raster, rgb, c.t >= 2});
    });
  }

 private:
  static constexpr size_t no_light = ~size_t{0};

  BidirectionalSampler paths_;
};

/// An estimator with the technique t = 1 alone.
class LightEstimator {
 public:
  LightEstimator(const Scene& scene, const PathRules& rules) : paths_(scene, {rules}) {}

  template <class Sampler>
  void operator()(const Vec2&, Sampler& sampler, std::vector<ImageLight>& light, RayCounts& rays) {
    paths_.sample_light(sampler, rays);
    paths_.connect_to_lens(
        rays, [&](const Connection& c) { light.push_back({c.raster, c.contribution, false}); });
  }

 private:
  BidirectionalSampler paths_;
};

}  // namespace mlt
