// Rendering by independent samples of each pixel: what path, direct, ptracer and bdpt share.
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
  std::string save() const override;
  void load(const std::string& saved) override;

 protected:
  /// Where samples go; invalid ones are counted and left out.
  class Sink {
   public:
    Sink(SampleFilm::Tile& tile, uint64_t& invalid) : tile_(&tile), invalid_(&invalid) {}
    /// Radiance at the sampled raster position.
    void add(const Vec2& raster, const Color& radiance) {
      if (valid(radiance)) tile_->add(raster, radiance);
    }
    /// What a walk from a light leaves anywhere on the image, over its density.
    void splat(const Vec2& raster, const Color& contribution) {
      if (valid(contribution)) tile_->splat(raster, contribution);
    }

   private:
    bool valid(const Color& color) {
      const bool ok = is_finite(color) && min_component(color) >= 0;
      if (!ok) ++*invalid_;
      return ok;
    }
    SampleFilm::Tile* tile_;
    uint64_t* invalid_;
  };

  /// Takes samples one after the other; keeps its memory between them.
  class Worker {
   public:
    virtual ~Worker() = default;
    /// The sampler has given the raster position and goes on with the lens and the time.
    virtual void sample(const Vec2& raster, PixelSampler& sampler, Sink& sink, RayCounts& rays) = 0;
  };
  virtual std::unique_ptr<Worker> make_worker() = 0;

  const Scene& scene() const { return *scene_; }
  /// Scale of a sum of contributions over the walks of all samples so far.
  double splat_scale() const { return film_.splat_scale(); }

 private:
  static constexpr int groups = 16;

  ScenePtr scene_;
  uint64_t seed_;
  SampleFilm film_;
  std::atomic<uint64_t> intersect_{0}, occluded_{0}, invalid_{0};
};

}  // namespace mlt
