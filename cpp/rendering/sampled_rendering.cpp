#include "rendering/sampled_rendering.h"

#include "base/bytes.h"
#include "rendering/hidden_lights.h"

#include <cmath>
#include <set>

namespace mlt {
namespace {

Plan plan_of(const SampleFilm& film, uint64_t passes_per_turn) {
  const uint64_t tiles = film.tile_count();
  Plan plan;
  plan.units_per_pass = tiles;
  plan.units_per_group_turn = passes_per_turn * tiles;
  if (!film.has_splats()) {
    plan.take_turns(tiles, 1);
    plan.borders = {0, tiles};
    return plan;
  }
  plan.take_turns(Rendering::group_count, plan.units_per_group_turn);
  plan.borders.clear();
  for (uint64_t group = 0; group <= Rendering::group_count; ++group) plan.borders.push_back(group);
  return plan;
}

}  // namespace

SampledRendering::SampledRendering(ScenePtr scene, uint64_t seed, const SampledSettings& settings,
                                   MakeTaker make_taker)
    : Rendering(std::move(scene), seed),
      make_taker_(std::move(make_taker)),
      passes_per_turn_(settings.passes_per_turn),
      only_camera_walks_(settings.only_camera_walks),
      film_(scene_->camera().raster().size.x, scene_->camera().raster().size.y,
            scene_->film().filter, group_count, settings.splats,
            scene_->camera().raster().border > 0),
      layer_names_(settings.layers),
      layers_(scene_->camera().raster().size.x, scene_->camera().raster().size.y,
              scene_->film().filter, static_cast<int>(layer_names_.size()),
              scene_->camera().raster().border > 0) {
  keep_light_layers(settings.light);
  if (light_layers_)
    for (int i = 0; i < light_layers_->count(); ++i)
      light_films_.push_back(std::make_unique<SampleFilm>(
          scene_->camera().raster().size.x, scene_->camera().raster().size.y, scene_->film().filter,
          group_count, settings.splats, scene_->camera().raster().border > 0));
  if (light_layers_ && settings.light.exposures) exposures_ = scene_->camera().shutter().exposures;
  plan_ = plan_of(film_, passes_per_turn_);
  plan_.samples_per_pass = exposures_;
}

SampledRendering::Place SampledRendering::place_of(uint64_t pass) const {
  const uint64_t turn = pass / passes_per_turn_;
  return {static_cast<int>(turn % group_count),
          turn / group_count * passes_per_turn_ + pass % passes_per_turn_};
}

/// Memory of the groups that a render of `spp` begins: sums are allocated with the first sample.
Rendering::Memory SampledRendering::memory(double spp) const {
  const double turns = std::ceil(spp / static_cast<double>(passes_per_turn_));
  const auto groups = static_cast<size_t>(std::min(turns, double{group_count}));
  const size_t bytes = groups * film_.bytes_per_group() * (1 + light_films_.size());
  return {bytes, bytes};
}

Replay SampledRendering::replay(const Vec2i& pixel, uint64_t sample) {
  Replay replay;
  RayCounts rays;
  SampleSink sink(replay);
  PixelSampler numbers =
      streams(sample / exposures_, static_cast<int>(sample % exposures_)).sampler(pixel.x, pixel.y);
  replay.raster = Vec2(pixel) + numbers.next2();
  make_taker_(scene())->sample(replay.raster, numbers, sink, rays);
  replay.radiance = mlt::shown(scene(), replay.radiance);
  return replay;
}

void SampledRendering::run_unit(uint64_t unit) {
  const uint64_t tiles = film_.tile_count(), pass = unit / tiles;
  const int tile_index = static_cast<int>(unit % tiles);
  const Place place = place_of(pass);
  const uint64_t order = place.index * tiles + tile_index;
  if (film_.has(place.group, order, tile_index)) return;
  SampleFilm::Tile tile = film_.begin(tile_index);
  std::vector<SampleFilm::Tile> light_tiles;
  for (const auto& film : light_films_) light_tiles.push_back(film->begin(tile_index));
  RayCounts rays;
  SampleSink sink(tile, layers_, light_layers_.get(), light_tiles);
  const std::unique_ptr<SampleTaker> taker = make_taker_(scene());
  for (int exposure = 0; exposure < exposures_; ++exposure)
    taker->sample_cells(tile.cells(), streams(pass, exposure), sink, rays);
  taker->finish(sink, rays);
  for (size_t i = 0; i < light_films_.size(); ++i)
    light_films_[i]->commit(place.group, order, tile_index, std::move(light_tiles[i]), exposures_);
  film_.commit(place.group, order, tile_index, std::move(tile), exposures_);
  invalid_ += sink.invalid();
  intersect_ += rays.intersect;
  occluded_ += rays.occluded;
}

/// The mean, stratified by tile, since some may have a sample more than others.
Estimate SampledRendering::mean_of(MeanSums SampleSums::* sums) const {
  std::vector<MeanSums> strata;
  for (const SampleSums& tile : film_.sums()) strata.push_back(tile.*sums);
  return stratified(strata, film_.tile_sizes());
}

WeightClasses SampledRendering::classes() const {
  WeightClasses all;
  for (const SampleSums& tile : film_.sums()) all += tile.classes;
  return all;
}

std::vector<NamedImage> SampledRendering::layers() const {
  std::vector<NamedImage> layers;
  const double scale = film_.splat_scale();
  for (size_t i = 0; i < layer_names_.size(); ++i) {
    std::vector<double> scales(layer_names_.size(), 0.0);
    scales[i] = scale;
    layers.push_back({layer_names_[i], shown(layers_.image(scales))});
  }
  return layers;
}

void SampledRendering::add_stats(Stats& stats) const {
  stats.rays_intersect = intersect_;
  stats.rays_occluded = occluded_;
  stats.invalid_samples = invalid_;
  if (only_camera_walks_) warn_of_hidden_lights(scene(), stats);
  if (layers_.saturated() > 0)
    stats.warnings.push_back(
        "a layer of the image exceeded its fixed-point range; its brightest pixels are wrong");
}

/// The film's sums of a task: of the groups of all passes that it overlaps.
SampleFilm::Selection SampledRendering::selection(const Task& task) const {
  const uint64_t tiles = film_.tile_count();
  std::set<int> groups;
  for (uint64_t pass = task.from / tiles; pass * tiles < task.to && groups.size() < group_count;
       ++pass)
    groups.insert(place_of(pass).group);
  return {{groups.begin(), groups.end()}, task.strands.first, task.strands.last};
}

std::string SampledRendering::save(const Task& task, Content content) const {
  const bool sums = content != Content::task;
  ByteWriter bytes;
  bytes.write(task);
  bytes.write(film_.save(selection(task)));
  for (const auto& film : light_films_) bytes.write(film->save(selection(task)));
  bytes.write(sums ? Counts{intersect_, occluded_, invalid_} : Counts{});
  bytes.write(sums ? layers_.save(0, layers_.group_count()) : std::string());
  return bytes.take();
}

void SampledRendering::load(const std::string& state) {
  ByteReader bytes(state);
  const auto task = bytes.read<Task>();
  std::string film, layers;
  std::vector<std::string> light(light_films_.size());
  bytes.read(film);
  for (std::string& light_film : light) bytes.read(light_film);
  const auto counts = bytes.read<Counts>();
  bytes.read(layers);
  bytes.finish();
  film_.load(film, selection(task));
  for (size_t i = 0; i < light.size(); ++i) light_films_[i]->load(light[i], selection(task));
  if (!layers.empty()) layers_.merge(0, layers_.group_count(), layers);
  intersect_ += counts[0];
  occluded_ += counts[1];
  invalid_ += counts[2];
}

}  // namespace mlt
