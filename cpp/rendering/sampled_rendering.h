// Rendering by independent samples of each pixel: the base of path, direct, ptracer and bdpt.
#pragma once

#include "base/registry.h"
#include "image/sample_film.h"
#include "image/splat_film.h"
#include "path/ray_counts.h"
#include "path/samplers.h"
#include "rendering/integrator.h"

#include <algorithm>
#include <array>
#include <functional>

namespace mlt {

/// Records samples in a film; invalid ones are counted and left out. When a sample is replayed
/// there is no film; its paths are recorded instead.
class SampleSink {
 public:
  SampleSink(SampleFilm::Tile& tile, SplatFilm& layers, const LightLayers* light,
             std::vector<SampleFilm::Tile>& light_tiles)
      : tile_(&tile), layers_(&layers), finder_(light), light_tiles_(&light_tiles) {}
  explicit SampleSink(Replay& replay) : replay_(&replay) {}

  /// Adds radiance at the sampled raster position.
  void add(const Vec2& raster, const Color& radiance) {
    if (!valid(radiance)) return;
    if (tile_)
      tile_->add(raster, radiance);
    else
      replay_->radiance += radiance;
  }
  /// As above, with the radiance of each layer of light.
  void add(const Vec2& raster, const Color& radiance, const std::vector<Color>& of_layers) {
    const uint64_t invalid_before = invalid_;
    add(raster, radiance);
    if (invalid_ > invalid_before) return;
    for (size_t i = 0; i < of_layers.size(); ++i)
      if (!is_black(of_layers[i])) (*light_tiles_)[i].add(raster, of_layers[i]);
  }
  /// Adds values that are no light, and may be negative.
  void add_signed(const Vec2& raster, const Color& values) {
    if (!is_finite(values)) return count_invalid();
    if (tile_) tile_->add(raster, values);
  }
  /// Adds a contribution of light tracing, over its density, anywhere on the image.
  void splat(const Vec2& raster, const Color& contribution, LayerMask layers = 0) {
    if (!valid(contribution) || !tile_) return;
    tile_->splat(raster, contribution);
    for_each_layer(layers, [&](int i) { (*light_tiles_)[i].splat(raster, contribution); });
  }
  /// Adds a contribution of light tracing to a layer of the film.
  void splat_layer(int layer, const Vec2& raster, const Color& contribution) {
    if (is_finite(contribution) && layers_) layers_->add(layer, raster, contribution);
  }
  /// Adds a sample to the estimates of the brightness.
  void add_sums(double brightness, double of_chains) {
    if (tile_) tile_->sums().add(brightness, of_chains);
  }
  void count_invalid() { ++invalid_; }
  /// Where found paths are recorded; usually nullptr.
  std::vector<FoundPath>* paths() { return replay_ ? &replay_->paths : nullptr; }
  /// Finds the layers of light that are kept.
  LightLayers::Finder& finder() { return finder_; }
  uint64_t invalid() const { return invalid_; }

 private:
  bool valid(const Color& color) {
    const bool ok = is_finite(color) && min_component(color) >= 0;
    if (!ok) ++invalid_;
    return ok;
  }
  SampleFilm::Tile* tile_ = nullptr;
  SplatFilm* layers_ = nullptr;
  LightLayers::Finder finder_{nullptr};
  std::vector<SampleFilm::Tile>* light_tiles_ = nullptr;
  Replay* replay_ = nullptr;
  uint64_t invalid_ = 0;
};

struct SampledSettings {
  bool splats = false;                   ///< Whether walks from lights splat anywhere on the image.
  std::vector<std::string> layers = {};  ///< Further images to be kept.
  /// Passes that go to a group before as many go to the next one; among them, samples are
  /// stratified. The more, the better stratified is a render of few samples; the fewer, the sooner
  /// it has several groups, from whose spread the error is estimated.
  uint64_t passes_per_turn = 8;
  bool only_camera_walks = false;  ///< See warn_of_hidden_lights.
  LightLayerSettings light = {};   ///< Only for an EstimatorTaker, whose estimator records paths.
};

/// Settings of algorithms whose walks begin at the camera.
inline SampledSettings camera_walks() {
  SampledSettings settings;
  settings.only_camera_walks = true;
  return settings;
}

/// The random numbers of one sample of each cell. All samples of a cell are from one sequence, of
/// which each group has blocks: together they are stratified better than each group is.
struct CellStreams {
  uint64_t seed;  ///< The seed, mixed (mix_bits).
  SampleIndex index;

  uint64_t stream(int x, int y) const {
    const uint64_t cell = (uint64_t(uint32_t(y)) << 32) | uint32_t(x);
    return mix_bits(seed ^ cell);
  }
  PixelSampler sampler(int x, int y) const { return {stream(x, y), index}; }
};

/// Calls take(cell) in an order in which those that follow each other are near: a packet of rays
/// has 4 x 2 cells.
template <class Take>
void for_each_packet_cell(const PixelRect& cells, Take&& take) {
  for (int y0 = cells.y0; y0 < cells.y1; y0 += 2)
    for (int x0 = cells.x0; x0 < cells.x1; x0 += 4)
      for (int y = y0; y < std::min(y0 + 2, cells.y1); ++y)
        for (int x = x0; x < std::min(x0 + 4, cells.x1); ++x) take(Vec2i(x, y));
}

/// Takes samples one after the other; reuses its buffers.
class SampleTaker {
 public:
  virtual ~SampleTaker() = default;
  /// Takes one sample for each of these cells.
  virtual void sample_cells(const PixelRect& cells, const CellStreams& streams, SampleSink& sink,
                            RayCounts& rays) {
    for (int y = cells.y0; y < cells.y1; ++y)
      for (int x = cells.x0; x < cells.x1; ++x) sample_cell({x, y}, streams, sink, rays);
  }
  /// Takes one sample. The sampler has given the raster position; its next numbers are those of
  /// the lens and the time.
  virtual void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
                      RayCounts& rays) = 0;
  void sample_cell(const Vec2i& cell, const CellStreams& streams, SampleSink& sink,
                   RayCounts& rays) {
    PixelSampler numbers = streams.sampler(cell.x, cell.y);
    const Vec2 raster = Vec2(cell) + numbers.next2();
    sample(raster, numbers, sink, rays);
  }
  /// To be called after the last sample.
  virtual void finish(SampleSink& /*sink*/, RayCounts& /*rays*/) {}
};

class SampledRendering : public Rendering {
 public:
  using MakeTaker = std::function<std::unique_ptr<SampleTaker>(const Scene&)>;
  SampledRendering(ScenePtr scene, uint64_t seed, const SampledSettings& settings,
                   MakeTaker make_taker);

  Memory memory(double spp) const override;
  /// Takes one sample for each cell of one tile, or one for each exposure that is kept apart.
  void run_unit(uint64_t unit) override;
  Image image(int layer = all_light) const override {
    return is_sum(layer) ? sum_of_lamps() : shown(film_of(layer).image());
  }
  GroupImage group(int index, int layer = all_light) const override {
    return {shown(film_of(layer).group_image(index)), static_cast<double>(film_.passes(index))};
  }
  bool groups_share_sequence() const override { return true; }
  const SampleFilm& film() const { return film_; }
  /// Samples that each cell receives in a pass.
  int exposures() const { return exposures_; }
  /// The mean brightness of its samples (SampleSums), if they record it.
  Estimate mean_brightness() const { return mean_of(&SampleSums::brightness); }
  Estimate mean_of_chains() const { return mean_of(&SampleSums::of_chains); }
  WeightClasses classes() const;
  std::vector<NamedImage> layers() const override;
  void add_stats(Stats& stats) const override;
  /// Repeats one sample, with its paths.
  Replay replay(const Vec2i& pixel, uint64_t sample) override;
  std::string save(const Task& task, Content content) const override;
  void load(const std::string& state) override;

 private:
  using Counts = std::array<uint64_t, 3>;  ///< Rays, shadow rays, invalid samples.

  struct Place {
    int group;
    uint64_t index;  ///< Index of the pass in its group.
  };
  Place place_of(uint64_t pass) const;
  const SampleFilm& film_of(int layer) const {
    return layer == all_light ? film_ : *light_films_[layer];
  }
  Estimate mean_of(MeanSums SampleSums::* sums) const;
  /// The film's sums of a task.
  SampleFilm::Selection selection(const Task& task) const;
  CellStreams streams(uint64_t pass, int exposure) const {
    return {mix_bits(seed_),
            {static_cast<uint32_t>(pass), static_cast<uint16_t>(exposure),
             static_cast<uint16_t>(exposures_)}};
  }

  MakeTaker make_taker_;
  uint64_t passes_per_turn_;
  bool only_camera_walks_;
  int exposures_ = 1;  ///< Samples of a cell in a pass: one for each exposure that is kept apart.
  SampleFilm film_;
  std::vector<std::string> layer_names_;
  SplatFilm layers_;                                      ///< A group for each layer.
  std::vector<std::unique_ptr<SampleFilm>> light_films_;  ///< One for each of light_layers().
  std::atomic<uint64_t> intersect_{0}, occluded_{0}, invalid_{0};
};

/// What a sampled integrator is if it does not say otherwise.
struct SampledDefaults {
  /// The settings with what has to be known of the scene.
  template <class Settings>
  static Settings prepared(const Settings& settings, const Scene& /*scene*/) {
    return settings;
  }
  /// The film that its settings ask for.
  template <class Settings>
  static SampledSettings film(const Settings&) {
    return {};
  }
  static LightLayerSettings light_layers(Params&) { return {}; }
};

/// An integrator by Own, a SampledDefaults with Own::settings(params), and Own::taker(scene,
/// settings) that takes its samples.
template <class Own>
class SampledIntegrator : public Integrator {
 public:
  explicit SampledIntegrator(Params& params)
      : settings_(Own::settings(params)), light_(Own::light_layers(params)) {}
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    const auto prepared = Own::prepared(settings_, *scene);
    SampledSettings film = Own::film(settings_);
    film.light = light_;
    return std::make_unique<SampledRendering>(
        std::move(scene), seed, film,
        [settings = prepared](const Scene& scene) { return Own::taker(scene, settings); });
  }

 private:
  decltype(Own::settings(std::declval<Params&>())) settings_;
  LightLayerSettings light_;
};

}  // namespace mlt
