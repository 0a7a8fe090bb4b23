// Rendering by independent samples of each pixel: what path, direct, ptracer and bdpt share.
#pragma once

#include "image/sample_film.h"
#include "integrator/integrator.h"
#include "path/ray_counts.h"
#include "path/samplers.h"

#include <array>

namespace mlt {

class SampledRendering : public Rendering {
 public:
  /// `splats`: walks from lights leave something anywhere on the image.
  SampledRendering(ScenePtr scene, uint64_t seed, bool splats);

  void prepare(int /*threads*/, const std::atomic<bool>& /*cancelled*/) override {}
  uint64_t unit_count(double spp) const override;
  /// A block of passes, which one group has by itself.
  uint64_t units_per_share() const override { return passes_of_block * film_.tile_count(); }
  /// One sample for each cell of one tile.
  void run_unit(uint64_t unit) override;
  double spp_done(uint64_t units) const override;
  Image image() const override { return film_.image(); }
  int group_count() const override { return groups; }
  GroupImage group(int index) const override {
    return {film_.group_image(index), static_cast<double>(film_.passes(index))};
  }
  void add_stats(Stats& stats) const override;
  /// `direct` tells the radiance alone, the others the paths too.
  Replay replay(const Vec2i& pixel, uint64_t sample) override;
  std::string save() const override;
  void load(const std::string& saved) override;
  /// A share is what the film says: a group, or a tile.
  uint64_t share_count() const override { return film_.share_count(); }
  uint64_t share_of(uint64_t unit) const override;
  uint64_t units_per_step() const override;
  std::vector<Part> parts(int wanted) const override;
  std::string lend(const Work& work) const override;
  void borrow(const Work& work, const std::string& lent) override;
  std::string give_back(const Work& work) const override;
  void take_back(const Work& work, const std::string& given_back) override;

 protected:
  /// Where samples go; invalid ones are counted and left out. When a sample is replayed there is no film
  /// but somebody to be told its paths.
  class Sink {
   public:
    Sink(SampleFilm::Tile& tile, uint64_t& invalid) : tile_(&tile), invalid_(&invalid) {}
    Sink(Replay& replay, uint64_t& invalid) : replay_(&replay), invalid_(&invalid) {}
    /// Radiance at the sampled raster position.
    void add(const Vec2& raster, const Color& radiance) {
      if (!valid(radiance)) return;
      if (tile_)
        tile_->add(raster, radiance);
      else
        replay_->radiance += radiance;
    }
    /// What a walk from a light leaves anywhere on the image, over its density.
    void splat(const Vec2& raster, const Color& contribution) {
      if (valid(contribution) && tile_) tile_->splat(raster, contribution);
    }
    /// Where found paths are to be told; usually nullptr.
    std::vector<FoundPath>* paths() { return replay_ ? &replay_->paths : nullptr; }

   private:
    bool valid(const Color& color) {
      const bool ok = is_finite(color) && min_component(color) >= 0;
      if (!ok) ++*invalid_;
      return ok;
    }
    SampleFilm::Tile* tile_ = nullptr;
    Replay* replay_ = nullptr;
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
  /// The more, the better stratified is a render of few samples; the fewer, the sooner it has several
  /// groups, whose spread tells its error.
  static constexpr uint64_t passes_of_block = 8;
  using Counts = std::array<uint64_t, 3>;  ///< Rays, shadow rays, invalid samples.

  void save_counts(ByteWriter& bytes) const;
  std::vector<int> groups_of(const Work& work) const;
  void load_shares(const Work& work, ByteReader& bytes);

  /// Blocks of passes over the image go to the groups in turn; within a block, samples are stratified.
  struct Place {
    int group;
    uint64_t index;  ///< Of the pass in its group.
  };
  static Place place_of(uint64_t pass);

  /// The numbers of one sample of a cell: those of its group's stream for it.
  PixelSampler sampler(int x, int y, uint64_t pass) const;

  ScenePtr scene_;
  uint64_t seed_;
  bool splats_;
  SampleFilm film_;
  std::atomic<uint64_t> intersect_{0}, occluded_{0}, invalid_{0};
};

}  // namespace mlt
