#include "rendering/metropolis_rendering.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mlt {

namespace {

double sum(const Image& image) {
  return std::accumulate(image.data.begin(), image.data.end(), 0.0);
}

}  // namespace

MetropolisRendering::MetropolisRendering(ScenePtr scene, uint64_t seed,
                                         const MetropolisSettings& settings,
                                         std::unique_ptr<MetropolisAlgorithm> algorithm,
                                         SeparateDirect direct)
    : Rendering(std::move(scene), seed),
      settings_(settings),
      algorithm_(std::move(algorithm)),
      direct_(std::move(direct)),
      film_(scene_->camera().raster().size.x, scene_->camera().raster().size.y,
            scene_->film().filter, group_count, scene_->camera().raster().border > 0) {
  keep_light_layers(settings.light);
  algorithm_->keep_layers(light_layers());
  if (light_layers_)
    for (int i = 0; i < light_layers_->count(); ++i)
      light_films_.push_back(std::make_unique<SplatFilm>(
          scene_->camera().raster().size.x, scene_->camera().raster().size.y, scene_->film().filter,
          group_count, scene_->camera().raster().border > 0));
}

int MetropolisRendering::chains_of(int group) const {
  return (settings_.chains + group_count - 1 - group) / group_count;
}

ChainId MetropolisRendering::chain_id(const ChainBatch& team, size_t chain) const {
  return {seed_, team.group, team.first + static_cast<int>(chain), chains_of(team.group),
          groups_[team.group].b};
}

std::unique_ptr<RenderChain> MetropolisRendering::blank_chain(const ChainBatch& team,
                                                              size_t chain) const {
  return algorithm_->blank(chain_id(team, chain), allocation_);
}

// ---- the layout of strands and units ------------------------------------------------------------

/// As many passes as samples alone would have, if they are the greater part; else one.
uint64_t MetropolisRendering::passes_per_turn() const {
  if (allocation_.share <= 0.5) return 1;
  return allocation_.techniques == SampleTechniques::path_tracing ? 8 : 4;
}

/// Lays out the strands, once b of each group is known.
void MetropolisRendering::lay_out() {
  samples_.reset();
  if (allocation_.share > 0)
    samples_ = std::make_unique<SampledRendering>(
        scene_, seed_, SampledSettings{true, {}, passes_per_turn(), false, settings_.light},
        [this](const Scene&) { return algorithm_->sample_taker(allocation_.weights); });
  plan_.borders.clear();
  for (uint64_t strand = 0; strand <= sample_strands(); ++strand) plan_.borders.push_back(strand);
  teams_.clear();
  for (int g = 0; g < group_count; ++g) {
    if (groups_[g].b > 0) form_teams(g);
    if (sample_strands() + teams_.size() > plan_.borders.back())
      plan_.borders.push_back(sample_strands() + teams_.size());
  }
  lay_out_units();
}

/// Divides the chains of a group into teams of about the same size.
void MetropolisRendering::form_teams(int group) {
  const int chains = chains_of(group), most = algorithm_->chains_together(),
            count = (chains + most - 1) / most;
  for (int i = 0; i < count; ++i) {
    const int first = chains * i / count, last = chains * (i + 1) / count;
    teams_.push_back(std::make_unique<ChainBatch>());
    teams_.back()->group = group;
    teams_.back()->first = first;
    teams_.back()->chains.resize(last - first);
  }
}

uint64_t MetropolisRendering::chain_count() const {
  uint64_t count = 0;
  for (const auto& team : teams_) count += team->chains.size();
  return count;
}

/// Divides the time: while all cells get a sample, the chains do their share of the work.
void MetropolisRendering::lay_out_units() {
  const uint64_t tiles = samples_ ? samples_->film().tile_count() : 0;
  double steps = pixels(), sampling = 0;
  if (samples_) {
    const std::vector<double> sizes = samples_->film().tile_sizes();
    sampling = allocation_.mutations_per_sample * samples_->exposures() *
               std::accumulate(sizes.begin(), sizes.end(), 0.0);
    steps = sampling * (1 - allocation_.share) / allocation_.share;
  }
  const double count = static_cast<double>(chain_count());
  const double turns = std::ceil(steps / most_steps_per_turn);
  uint64_t rounds = 0;  // of all chains
  if (!teams_.empty()) {
    steps_per_unit_ = static_cast<uint64_t>(std::max(1.0, std::round(steps / (count * turns))));
    rounds = static_cast<uint64_t>(std::max(1.0, turns));
  }
  interleaving_ = Interleaving(tiles, rounds * teams_.size());

  const uint64_t round = interleaving_.units_per_round();
  plan_.least_units = tiles > 0 ? tiles + round : 0;
  plan_.units_per_pass = samples_ ? 1 : teams_.size();
  plan_.samples_per_pass = (sampling + static_cast<double>(rounds * steps_per_unit_) * count) /
                           static_cast<double>(round) * static_cast<double>(plan_.units_per_pass);
  plan_.pixels = pixels();
  plan_.units_per_group_turn = round;
  plan_.units_per_cycle = (samples_ ? samples_->plan().units_per_cycle / tiles : 1) * round;
  plan_.strand_of = [this](uint64_t unit) {
    const Interleaving::Place place = interleaving_.place_of(unit);
    return place.sampled ? samples_->plan().strand_of(place.number)
                         : sample_strands() + place.number % teams_.size();
  };
}

/// Every group of chains has a sum of 64 bits for each channel, from the beginning. Those of the
/// samples come beside them: six floats a pixel for each group, that is as much.
Rendering::Memory MetropolisRendering::memory(double /*spp*/) const {
  const Vec2i size = scene().camera().raster().size;
  const size_t films = 1 + light_films_.size(),
               chains = size_t{24} * group_count * films * size.x * size.y;
  const size_t samples = settings_.independent_share == 0 ? 0 : chains;
  return {chains + samples, samples};
}

// ---- the units --------------------------------------------------------------------------------

void MetropolisRendering::run_unit(uint64_t unit) {
  const Interleaving::Place place = interleaving_.place_of(unit);
  if (place.sampled)
    samples_->run_unit(place.number);
  else
    run_batch(place.number);
}

void MetropolisRendering::run_batch(uint64_t number) {
  ChainBatch& team = *teams_[number % teams_.size()];
  const uint64_t units_before = number / teams_.size();
  std::unique_lock lock(team.mutex);
  team.turn.wait(lock, [&] { return team.units >= units_before; });
  if (team.units > units_before) return;
  // Whatever happens, the thread that waits for the team's next unit must go on.
  struct Done {
    ChainBatch& team;
    ~Done() {
      ++team.units;
      team.turn.notify_all();
    }
  } done{team};
  FilmRecorder recorder(film_, light_layers_.get(), light_films_, team.group, allocation_.weights);
  std::vector<ChainVisit> visits;
  for (const auto& chain : team.chains) visits.push_back({chain.get(), &recorder});
  algorithm_->advance(visits, steps_per_unit_);
  team.brightness += recorder.brightness();
  groups_[team.group].steps += steps_per_unit_ * team.chains.size();
}

// ---- the image --------------------------------------------------------------------------------

std::vector<GroupProgress> MetropolisRendering::progress() const {
  std::vector<GroupProgress> groups;
  for (const Group& group : groups_) groups.push_back({group.b, group.bootstrap, group.steps});
  for (const auto& team : teams_) {
    const std::lock_guard lock(team->mutex);
    groups[team->group].brightness += team->brightness;
    for (const auto& chain : team->chains) {
      if (!chain) continue;
      groups[team->group].due += chain->light_due();
      if (chain->samples()) groups[team->group].bootstrap += *chain->samples();
    }
  }
  return groups;
}

GroupEstimator MetropolisRendering::group_estimator() const {
  return {progress(), samples_ ? samples_->mean_of_chains() : Estimate(), !algorithm_->has_tours()};
}

/// A pixel's value is the pixel count times the light that falls into it.
Image MetropolisRendering::chain_image(GroupWeights scales, int layer) const {
  for (double& scale : scales) scale *= pixels();
  return shown(film_of(layer).image(scales));
}

std::vector<const Rendering*> MetropolisRendering::parts() const {
  std::vector<const Rendering*> parts;
  if (direct_.rendering) parts.push_back(direct_.rendering.get());
  if (samples_) parts.push_back(samples_.get());
  return parts;
}

Image MetropolisRendering::image(int layer) const {
  if (is_sum(layer)) return sum_of_lamps();
  Image image = chain_image(group_estimator().mean(), layer);
  for (const Rendering* part : parts()) image += part->image(layer);
  return image;
}

GroupImage MetropolisRendering::group(int index, int layer) const {
  const GroupEstimator groups = group_estimator();
  const MeanSums b = progress()[index].bootstrap.brightness;
  return {chain_image(groups.group(index), layer), groups.begun(index) ? 1.0 : 0.0, b.mean(),
          std::sqrt(b.variance_of_mean())};
}

Image MetropolisRendering::common_error(int layer) const {
  if (!samples_) return {};
  const GroupEstimator groups = group_estimator();
  Image error = chain_image(groups.common_error(), layer);
  if (const double excess = groups.excess(); excess > 0) {
    const Image shown = image(layer);
    const double share = excess * sum(chain_image(groups.mean(), all_light)) / sum(image());
    for (size_t i = 0; i < error.data.size(); ++i)
      error.data[i] += static_cast<float>(share * shown.data[i]);
  }
  return error;
}

std::vector<NamedImage> MetropolisRendering::layers() const {
  if (!settings_.parts) return {};
  const Vec2i size = scene_->camera().raster().size;
  return {{"chains", chain_image(group_estimator().mean(), all_light)},
          {"samples", samples_ ? samples_->image() : Image(size.x, size.y, 3)}};
}

}  // namespace mlt
