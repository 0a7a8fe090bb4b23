#include "integrator/metropolis_rendering.h"

#include "base/parallel.h"
#include "base/watchdog.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

namespace mlt {

MetropolisRendering::MetropolisRendering(ScenePtr scene, uint64_t seed,
                                         const MetropolisSettings& settings,
                                         std::unique_ptr<MetropolisAlgorithm> algorithm,
                                         SeparateDirect direct)
    : Rendering(std::move(scene), seed),
      settings_(settings),
      algorithm_(std::move(algorithm)),
      direct_(std::move(direct)),
      film_(scene_->camera().raster().size.x, scene_->camera().raster().size.y,
            scene_->film().filter, group_count) {}

int MetropolisRendering::chains_of(int group) const {
  return (settings_.chains + group_count - 1 - group) / group_count;
}

ChainId MetropolisRendering::chain_id(const ChainTeam& team, size_t chain) const {
  return {seed_, team.group, team.first + static_cast<int>(chain), chains_of(team.group),
          groups_[team.group].b};
}

// ---- before the first unit --------------------------------------------------------------------

void MetropolisRendering::render_direct(int threads, const std::atomic<bool>& cancelled) {
  Rendering& direct = *direct_.rendering;
  direct.prepare(threads, cancelled);
  parallel_for(threads, direct.plan().unit_count(direct_.spp), [&](uint64_t unit) {
    if (!cancelled) direct.run_unit(unit);
  });
}

void MetropolisRendering::prepare(int threads, const std::atomic<bool>& cancelled) {
  if (direct_.rendering) render_direct(threads, cancelled);
  if (std::isinf(preparation_seconds_) || settings_.independent_share == 0) {
    prepare_chains(threads, cancelled);
    return;
  }
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(preparation_seconds_);
  bool in_time = false;
  try {
    const Watchdog watchdog([&] { return cancelled || Clock::now() >= end; }, 0);
    prepare_chains(threads, watchdog.stop());
    in_time = !watchdog.stop();
  } catch (const Abandoned&) {
  }
  if (!in_time && !cancelled) do_without_chains();
}

/// A render too short for pilot and bootstrap is one of independent samples.
void MetropolisRendering::do_without_chains() {
  for (Group& group : groups_) {
    group.b = 0;
    group.bootstrap = {};
  }
  allocation_ = samples_alone(settings_.techniques.value_or(SampleTechniques::all));
  allocation_.in_time = false;
  algorithm_->set_techniques(allocation_.techniques);
  lay_out();
}

void MetropolisRendering::prepare_chains(int threads, const std::atomic<bool>& cancelled) {
  allocation_ = run_pilot(threads, cancelled);
  if (cancelled) return;
  if (allocation_.share == 1)
    lay_out();
  else
    start_chains(threads, cancelled);
}

Allocation MetropolisRendering::run_pilot(int threads, const std::atomic<bool>& cancelled) {
  if (settings_.independent_share == 1) {
    const SampleTechniques techniques = settings_.techniques.value_or(SampleTechniques::all);
    algorithm_->set_techniques(techniques);
    return samples_alone(techniques);
  }
  PilotSettings pilot;
  pilot.seed = seed_;
  pilot.threads = threads;
  pilot.coarse_samples = settings_.luminance_samples / 3;
  pilot.samples = settings_.luminance_samples / 6;
  pilot.chains = std::min(pilot.chains, settings_.chains);
  pilot.share = settings_.independent_share;
  pilot.techniques = settings_.techniques;
  const Raster& raster = scene_->camera().raster();
  const CoarseImage coarse = coarse_image(*algorithm_, raster, pilot, cancelled);
  algorithm_->prepare(coarse, seed_, threads, cancelled);
  if (settings_.independent_share == 0) return {};
  return allocate(*algorithm_, raster, coarse.map, pilot, cancelled);
}

void MetropolisRendering::start_chains(int threads, const std::atomic<bool>& cancelled) {
  const uint64_t per_group = (settings_.luminance_samples + group_count - 1) / group_count;
  const Candidates candidates{seed_, Purpose::bootstrap, per_group * group_count};
  const auto seeds = run_bootstrap(candidates, threads, cancelled);
  if (cancelled) return;
  lay_out();
  if (teams_.empty() && !samples_) throw no_light_found(candidates.count);
  parallel_for(threads, teams_.size(), [&](uint64_t i) {
    ChainTeam& team = *teams_[i];
    for (size_t k = 0; k < team.chains.size(); ++k) {
      const ChainId id = chain_id(team, k);
      const uint64_t candidate = id.group * per_group + seeds[id.group][id.number];
      team.chains[k] = algorithm_->start(
          id, candidates.rng(candidate),
          Rng(seed_, Purpose::choice, static_cast<uint64_t>(id.number) * group_count + id.group));
    }
  });
}

/// Each group has its own part of the candidates, and resamples the starts of its chains from them.
std::vector<std::vector<uint32_t>> MetropolisRendering::run_bootstrap(
    const Candidates& candidates, int threads, const std::atomic<bool>& cancelled) {
  const std::vector<SampleWeights> weights = draw_candidates(
      candidates, threads, cancelled, [&] { return algorithm_->source(); },
      [&](MetropolisAlgorithm::Source& source, Rng& rng) {
        return weigh(source, scene_->camera().raster(), RandomSampler(rng), allocation_.weights);
      },
      [&](const MetropolisAlgorithm::Source& source) { bootstrap_rays_ += source.rays(); });
  std::vector<std::vector<uint32_t>> seeds(group_count);
  const uint64_t per_group = candidates.count / group_count;
  for (int g = 0; g < group_count; ++g) {
    std::vector<double> targets;
    for (uint64_t i = g * per_group; i < (g + 1) * per_group; ++i) {
      targets.push_back(weights[i].target);
      groups_[g].bootstrap.brightness.add(weights[i].brightness);
      groups_[g].bootstrap.classes.add(weights[i].brightness);
      // The weights of a candidate are those of all techniques.
      if (allocation_.techniques == SampleTechniques::all)
        groups_[g].bootstrap.of_chains.add(weights[i].of_chains);
    }
    Rng rng(seed_, Purpose::resample, g);
    Bootstrap bootstrap = resample(targets, chains_of(g), rng);
    groups_[g].b = bootstrap.b;
    seeds[g] = std::move(bootstrap.seeds);
  }
  return seeds;
}

/// As many as samples alone would have, if they are the greater part.
uint64_t MetropolisRendering::passes_per_turn() const {
  if (allocation_.share <= 0.5) return 1;
  return allocation_.techniques == SampleTechniques::path_tracing ? 8 : 4;
}

/// Which shares there are, once b of each group is known.
void MetropolisRendering::lay_out() {
  samples_.reset();
  if (allocation_.share > 0)
    samples_ = std::make_unique<SampledRendering>(
        scene_, seed_, SampledSettings{true, {}, passes_per_turn()},
        [this](const Scene&) { return algorithm_->sample_taker(allocation_.weights); });
  plan_.borders.clear();
  for (uint64_t share = 0; share <= sample_shares(); ++share) plan_.borders.push_back(share);
  teams_.clear();
  for (int g = 0; g < group_count; ++g) {
    if (groups_[g].b > 0) form_teams(g);
    if (sample_shares() + teams_.size() > plan_.borders.back())
      plan_.borders.push_back(sample_shares() + teams_.size());
  }
  lay_out_units();
}

/// Of about the same size.
void MetropolisRendering::form_teams(int group) {
  const int chains = chains_of(group), most = algorithm_->chains_together(),
            count = (chains + most - 1) / most;
  for (int i = 0; i < count; ++i) {
    const int first = chains * i / count, last = chains * (i + 1) / count;
    teams_.push_back(std::make_unique<ChainTeam>());
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

/// How the time is divided: while all cells get a sample, the chains do their share of the work.
void MetropolisRendering::lay_out_units() {
  const uint64_t tiles = samples_ ? samples_->film().tile_count() : 0;
  double steps = pixels(), sampling = 0;
  if (samples_) {
    const std::vector<double> sizes = samples_->film().tile_sizes();
    sampling = allocation_.mutations_per_sample * std::accumulate(sizes.begin(), sizes.end(), 0.0);
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
  plan_.share_of = [this](uint64_t unit) {
    const Interleaving::Place place = interleaving_.place_of(unit);
    return place.sampled ? samples_->plan().share_of(place.number)
                         : sample_shares() + place.number % teams_.size();
  };
}

/// Every group of chains has a sum of 64 bits for each channel, from the beginning. Those of the
/// samples come beside them: six floats a pixel for each group, that is as much.
Rendering::Memory MetropolisRendering::memory(double /*spp*/) const {
  const Vec2i size = scene().camera().raster().size;
  const size_t chains = size_t{24} * group_count * size.x * size.y;
  const size_t samples = settings_.independent_share == 0 ? 0 : chains;
  return {chains + samples, samples};
}

// ---- the units --------------------------------------------------------------------------------

void MetropolisRendering::run_unit(uint64_t unit) {
  const Interleaving::Place place = interleaving_.place_of(unit);
  if (place.sampled)
    samples_->run_unit(place.number);
  else
    run_team(place.number);
}

void MetropolisRendering::run_team(uint64_t number) {
  ChainTeam& team = *teams_[number % teams_.size()];
  const uint64_t units_before = number / teams_.size();
  std::unique_lock lock(team.mutex);
  team.turn.wait(lock, [&] { return team.units >= units_before; });
  if (team.units > units_before) return;
  // Whatever happens, the thread that waits for the team's next unit must go on.
  struct Done {
    ChainTeam& team;
    ~Done() {
      ++team.units;
      team.turn.notify_all();
    }
  } done{team};
  FilmRecorder recorder(film_, team.group, allocation_.weights);
  std::vector<ChainVisit> visits;
  for (const auto& chain : team.chains) visits.push_back({chain.get(), &recorder});
  algorithm_->advance(visits, steps_per_unit_);
  team.brightness += recorder.brightness();
  groups_[team.group].steps += steps_per_unit_ * team.chains.size();
}

// ---- what has come of them --------------------------------------------------------------------

GroupCombination MetropolisRendering::combination() const {
  std::vector<GroupProgress> groups;
  for (const Group& group : groups_) groups.push_back({group.b, group.bootstrap, group.steps});
  for (const auto& team : teams_) {
    const std::lock_guard lock(team->mutex);
    groups[team->group].brightness += team->brightness;
  }
  return GroupCombination(std::move(groups), samples_ ? samples_->mean_of_chains() : Estimate());
}

/// Pixels are the pixel count times what falls into them.
Image MetropolisRendering::chain_image(GroupScales scales) const {
  for (double& scale : scales) scale *= pixels();
  return film_.image(scales);
}

std::vector<const Rendering*> MetropolisRendering::parts() const {
  std::vector<const Rendering*> parts;
  if (direct_.rendering) parts.push_back(direct_.rendering.get());
  if (samples_) parts.push_back(samples_.get());
  return parts;
}

Image MetropolisRendering::image() const {
  Image image = chain_image(combination().mean());
  for (const Rendering* part : parts()) image += part->image();
  return image;
}

GroupImage MetropolisRendering::group(int index) const {
  const GroupCombination groups = combination();
  const MeanSums& b = groups_[index].bootstrap.brightness;
  return {chain_image(groups.group(index)), groups.begun(index) ? 1.0 : 0.0, b.mean(),
          std::sqrt(b.variance_of_mean())};
}

Image MetropolisRendering::common_error() const {
  return samples_ ? chain_image(combination().common_error()) : Image();
}

std::vector<NamedImage> MetropolisRendering::layers() const {
  if (!settings_.parts) return {};
  const Vec2i size = scene_->camera().raster().size;
  return {{"chains", chain_image(combination().mean())},
          {"samples", samples_ ? samples_->image() : Image(size.x, size.y, 3)}};
}

}  // namespace mlt
