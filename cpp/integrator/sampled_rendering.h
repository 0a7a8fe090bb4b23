// Rendering by independent samples of each pixel: what `path` and `direct` share.
#pragma once

#include "image/sample_film.h"
#include "integrator/integrator.h"
#include "path/ray_counts.h"
#include "path/samplers.h"

namespace mlt {

class SampledRendering : public Rendering {
 public:
  SampledRendering(ScenePtr scene, uint64_t seed);

  void prepare(int /*threads*/, const std::atomic<bool>& /*cancelled*/) override {}
  uint64_t unit_count(double spp) const override;
  /// One sample for each cell of one tile; passes over the image go to the groups in turn.
  void run_unit(uint64_t unit) override;
  double spp_done(uint64_t units) const override;
  Image image() const override { return film_.image(); }
  void add_stats(Stats& stats) const override;
  std::string save() const override { return film_.save(); }
  void load(const std::string& bytes) override { film_.load(bytes); }

 protected:
  /// The radiance that arrives along a camera ray.
  virtual Color radiance(const Ray& ray, PixelSampler& sampler, RayCounts& rays) const = 0;

  const Scene& scene() const { return *scene_; }

 private:
  static constexpr int groups = 16;

  ScenePtr scene_;
  uint64_t seed_;
  SampleFilm film_;
  std::atomic<uint64_t> intersect_{0}, occluded_{0}, invalid_{0};
};

}  // namespace mlt
