// Before the first unit of a Metropolis render: a pilot divides the time, and a bootstrap starts
// chains.
#include "base/parallel.h"
#include "base/watchdog.h"
#include "rendering/coarse_image.h"
#include "rendering/metropolis_rendering.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mlt {

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
    prepare_chains(threads, cancelled, cancelled);
    return;
  }
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(4 * preparation_seconds_);
  try {
    // At the end of the time, preparation makes do with what was drawn; a walk that goes on and on
    // is abandoned.
    const Watchdog watchdog([&] { return cancelled || Clock::now() >= end; },
                            2 * preparation_seconds_);
    if (prepare_chains(threads, watchdog.stop(), cancelled)) return;
  } catch (const Abandoned&) {
  }
  if (!cancelled) do_without_chains();
}

/// Makes a render that is too short for pilot and bootstrap one of independent samples.
void MetropolisRendering::do_without_chains() {
  for (Group& group : groups_) {
    group.b = 0;
    group.bootstrap = {};
  }
  SampleTechniques techniques = settings_.techniques.value_or(SampleTechniques::path_tracing);
  if (!algorithm_->set_techniques(techniques))
    algorithm_->set_techniques(techniques = SampleTechniques::all);
  allocation_ = samples_alone(techniques);
  allocation_.in_time = false;
  algorithm_->end_pilot();
  lay_out();
}

/// Prepares all that comes before the first unit; what takes its time ends when `late`. Returns
/// whether there are chains, or none are wanted.
bool MetropolisRendering::prepare_chains(int threads, const std::atomic<bool>& late,
                                         const std::atomic<bool>& cancelled) {
  allocation_ = run_pilot(threads, late);
  algorithm_->end_pilot();
  if (cancelled) return false;
  if (allocation_.share == 1) {
    if (late && settings_.independent_share != 1) return false;
    lay_out();
  } else if (algorithm_->has_tours()) {
    start_tours();
  } else {
    start_chains(threads, cancelled);  // as many as it can afford, even if the pilot was late
    return !cancelled;
  }
  return true;
}

/// The share of a pilot's samples that it can afford. Samples that search for light through glass
/// may take a thousand times as many rays as others. Rays are counted, not seconds, so that equal
/// seeds have equal pilots on any number of threads: one traces them in about preparation_seconds_,
/// or in two and a half seconds.
double MetropolisRendering::affordable_share(const std::atomic<bool>& cancelled) {
  constexpr double per_second = 1 << 20, to_try = 1. / 32, usual = 50000;
  const double rays = per_second * std::min(preparation_seconds_, 2.5),
               given = static_cast<double>(settings_.luminance_samples),
               samples = std::isinf(preparation_seconds_) ? usual : std::max(usual, given);
  const auto source = algorithm_->source();
  const uint64_t stream = mix_bits(seed_ ^ mix_bits(uint64_t(Purpose::map)));
  uint32_t tried = 0;
  double taken = 1;
  for (; tried < 64 && taken < rays * to_try && !cancelled; ++tried) {
    PixelSampler sampler(stream, tried);
    source->sample(scene_->camera().raster().sample(sampler.next2()), sampler);
    taken = 1 + static_cast<double>(source->rays().total());
  }
  return std::min(1.0, rays * tried / (taken * samples));
}

Allocation MetropolisRendering::run_pilot(int threads, const std::atomic<bool>& cancelled) {
  if (settings_.independent_share == 1) {
    const SampleTechniques techniques = settings_.techniques.value_or(SampleTechniques::all);
    algorithm_->set_techniques(techniques);
    return samples_alone(techniques);
  }
  algorithm_->learn(preparation_seconds_);
  const double share = affordable_share_ = affordable_share(cancelled);
  algorithm_->look_around(share, seed_, threads, cancelled);
  const AllocationSettings settings{seed_, threads,
                                    affordable(share, settings_.luminance_samples / 6),
                                    settings_.independent_share, settings_.techniques};
  const Raster& raster = scene_->camera().raster();
  const uint64_t samples = affordable(share, settings_.luminance_samples / 3);
  CoarseImage coarse = coarse_image(*algorithm_, raster, seed_, samples, threads, cancelled);
  coarse.share = share;
  algorithm_->prepare(coarse, seed_, threads, cancelled);
  if (settings_.independent_share == 0 && !algorithm_->has_tours()) return {};
  Allocation allocation = allocate(*algorithm_, coarse, settings, cancelled);
  if (settings_.steps_per_start)
    allocation = tours_alone(allocation.brightness, *settings_.steps_per_start);
  algorithm_->set_weights(allocation.weights);
  if (!cancelled) algorithm_->adapt(share, seed_, threads, cancelled);
  return allocation;
}

/// Starts tours, which need no bootstrap.
void MetropolisRendering::start_tours() {
  for (Group& group : groups_) group.b = allocation_.kappa0 * allocation_.steps_per_start;
  lay_out();
  for (const auto& team : teams_)
    for (size_t k = 0; k < team->chains.size(); ++k) team->chains[k] = blank_chain(*team, k);
}

void MetropolisRendering::start_chains(int threads, const std::atomic<bool>& cancelled) {
  const uint64_t per_group =
      (affordable(affordable_share_, settings_.luminance_samples) + group_count - 1) / group_count;
  const Candidates candidates{seed_, Purpose::bootstrap, per_group * group_count};
  const auto seeds = run_bootstrap(candidates, threads, cancelled);
  if (cancelled) return;
  lay_out();
  if (teams_.empty() && !samples_) throw no_light_found(candidates.count);
  parallel_for(threads, teams_.size(), [&](uint64_t i) {
    ChainBatch& team = *teams_[i];
    for (size_t k = 0; k < team.chains.size(); ++k) {
      const ChainId id = chain_id(team, k);
      const uint64_t candidate = id.group * per_group + seeds[id.group][id.number];
      team.chains[k] = algorithm_->start(
          id, candidates.rng(candidate),
          Rng(seed_, Purpose::choice, static_cast<uint64_t>(id.number) * group_count + id.group));
    }
  });
}

/// Resamples the starts of the chains of each group from its own part of the candidates.
std::vector<std::vector<uint32_t>> MetropolisRendering::run_bootstrap(
    const Candidates& candidates, int threads, const std::atomic<bool>& cancelled) {
  const std::vector<SampleWeights> weights = draw_candidates(
      candidates, threads, cancelled, [&] { return algorithm_->source(); },
      [&](MetropolisAlgorithm::Source& source, Rng& rng) {
        return weigh(source, scene_->camera().raster(), RandomSampler(rng), allocation_.weights);
      },
      [&](const MetropolisAlgorithm::Source& source) { bootstrap_rays_ += source.rays(); });
  if (cancelled) return {};
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

}  // namespace mlt
