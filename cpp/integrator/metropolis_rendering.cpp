#include "integrator/metropolis_rendering.h"

#include "base/parallel.h"
#include "markov/bootstrap.h"

#include <algorithm>
#include <cmath>

namespace mlt {

MetropolisRendering::MetropolisRendering(ScenePtr scene, uint64_t seed,
                                         const MetropolisSettings& settings,
                                         const Allocation& allocation,
                                         std::unique_ptr<MetropolisAlgorithm> algorithm,
                                         SeparateDirect direct)
    : Rendering(std::move(scene), seed),
      settings_(settings),
      allocation_(allocation),
      algorithm_(std::move(algorithm)),
      direct_(std::move(direct)),
      chain_film_(make_film()),
      sample_film_(make_film()),
      steps_per_unit_(std::min(most_steps_per_unit,
                               static_cast<uint64_t>(std::ceil(pixels() / settings.chains)))) {}

SplatFilm MetropolisRendering::make_film() const {
  const Vec2i size = scene_->camera().raster().size;
  return {size.x, size.y, scene_->film().filter, group_count};
}

int MetropolisRendering::chains_of(int group) const {
  return (settings_.chains + group_count - 1 - group) / group_count;
}

ChainId MetropolisRendering::chain_id(const Share& share) const {
  return {seed_, share.group, share.number, chains_of(share.group)};
}

void MetropolisRendering::render_direct(int threads, const std::atomic<bool>& cancelled) {
  Rendering& direct = *direct_.rendering;
  direct.prepare(threads, cancelled);
  parallel_for(threads, direct.plan().unit_count(direct_.spp), [&](uint64_t unit) {
    if (!cancelled) direct.run_unit(unit);
  });
}

void MetropolisRendering::prepare(int threads, const std::atomic<bool>& cancelled) {
  if (direct_.rendering) render_direct(threads, cancelled);
  const uint64_t per_group = (settings_.luminance_samples + group_count - 1) / group_count;
  const Candidates candidates{seed_, Purpose::bootstrap, per_group * group_count};
  const auto seeds = run_bootstrap(candidates, threads, cancelled);
  if (cancelled) return;
  lay_out();
  if (std::none_of(shares_.begin(), shares_.end(), [](const auto& s) { return !s->samples; }))
    throw RenderError(
        "no light path was found among " + std::to_string(candidates.count) +
        " bootstrap samples; give more luminance_samples, or check that light can reach "
        "the camera");
  parallel_for(threads, shares_.size(), [&](uint64_t i) {
    Share& share = *shares_[i];
    if (share.samples) return;
    const uint64_t candidate = share.group * per_group + seeds[share.group][share.number];
    share.chain =
        algorithm_->start(chain_id(share), candidates.rng(candidate),
                          Rng(seed_, Purpose::choice,
                              static_cast<uint64_t>(share.number) * group_count + share.group));
  });
}

/// Each group has its own part of the candidates, and resamples the starts of its chains from them.
std::vector<std::vector<uint32_t>> MetropolisRendering::run_bootstrap(
    const Candidates& candidates, int threads, const std::atomic<bool>& cancelled) {
  const uint64_t per_group = candidates.count / group_count;
  std::vector<std::vector<uint32_t>> seeds(group_count);
  std::mutex mutex;
  parallel_for(threads, group_count, [&](uint64_t g) {
    const auto source = algorithm_->source();
    std::vector<double> weights;
    SampleSums& sums = groups_[g].bootstrap;
    for (uint64_t i = g * per_group; i < (g + 1) * per_group && !cancelled; ++i) {
      Rng rng = candidates.rng(i);
      double weight = 0;
      take_sample(*source, RandomSampler(rng), allocation_.weights, sums,
                  [&](const FoundLight& found) { weight += found.weight; });
      weights.push_back(weight);
    }
    Rng rng(seed_, Purpose::resample, g);
    seeds[g] = resample(weights, chains_of(static_cast<int>(g)), rng).seeds;
    const std::lock_guard lock(mutex);
    bootstrap_rays_ += source->rays();
  });
  return seeds;
}

/// Into how many sequences the samples of a group are divided, so that a unit of samples takes
/// about as long as one of chains.
void MetropolisRendering::divide_samples() {
  if (allocation_.share == 0) return;
  const double steps = static_cast<double>(steps_per_unit_) * settings_.chains / group_count;
  const double samples =
      steps / allocation_.mutations_per_sample * allocation_.share / (1 - allocation_.share);
  const double unit =
      std::max(1.0, static_cast<double>(steps_per_unit_) / allocation_.mutations_per_sample);
  const double sequences = std::max(1.0, std::round(samples / unit));
  sequences_ = static_cast<int>(sequences);
  samples_per_unit_ = static_cast<uint64_t>(std::max(1.0, std::round(samples / sequences)));
}

std::unique_ptr<IndependentSamples> MetropolisRendering::samples_of(int group, int number) const {
  const uint64_t stream = mix_bits(mix_bits(seed_ ^ mix_bits(uint64_t(Purpose::sample))) + group);
  return std::make_unique<IndependentSamples>(*algorithm_, stream, number, sequences_);
}

/// Which shares there are, once b of each group is known.
void MetropolisRendering::lay_out() {
  shares_.clear();
  plan_.borders = {0};
  const auto add = [&](int group, int number) -> Share& {
    shares_.push_back(std::make_unique<Share>());
    shares_.back()->group = group;
    shares_.back()->number = number;
    return *shares_.back();
  };
  divide_samples();
  uint64_t chains = 0;
  for (int g = 0; g < group_count; ++g) {
    for (int number = 0; number < sequences_; ++number)
      add(g, number).samples = samples_of(g, number);
    const int own = groups_[g].bootstrap.target.mean() > 0 ? chains_of(g) : 0;
    for (int number = 0; number < own; ++number) add(g, number);
    chains += own;
    if (shares_.size() > plan_.borders.back()) plan_.borders.push_back(shares_.size());
  }
  plan_.units_per_pass = plan_.units_per_group_turn = shares_.size();
  plan_.samples_per_pass =
      static_cast<double>(chains * steps_per_unit_) +
      allocation_.mutations_per_sample *
          static_cast<double>(samples_per_unit_ * static_cast<uint64_t>(sequences_ * group_count));
  plan_.pixels = pixels();
}

void MetropolisRendering::run_unit(uint64_t unit) {
  Share& share = *shares_[unit % shares_.size()];
  const uint64_t units_before = unit / shares_.size();
  std::unique_lock lock(share.mutex);
  share.turn.wait(lock, [&] { return share.units >= units_before; });
  if (share.units > units_before) return;
  // Whatever happens, the thread that waits for the share's next unit must go on.
  struct Done {
    Share& share;
    ~Done() {
      ++share.units;
      share.turn.notify_all();
    }
  } done{share};
  if (share.samples) {
    share.samples->advance(samples_per_unit_, sample_film_, share.group, allocation_.weights,
                           1 / allocation_.b0);
  } else {
    FilmRecorder recorder(chain_film_, share.group, allocation_.weights);
    share.chain->advance(steps_per_unit_, recorder);
    share.brightness += recorder.brightness();
    groups_[share.group].steps += steps_per_unit_;
  }
}

GroupCombination MetropolisRendering::combination() const {
  std::vector<GroupProgress> groups;
  for (const Group& group : groups_) groups.push_back({group.bootstrap, {}, group.steps});
  for (const auto& share : shares_) {
    const std::lock_guard lock(share->mutex);
    groups[share->group].brightness += share->brightness;
    if (share->samples) groups[share->group].samples += share->samples->sums();
  }
  return GroupCombination(std::move(groups));
}

/// Pixels are the pixel count times what falls into them; samples are recorded in units of b0.
Image MetropolisRendering::image(GroupScales scales) const {
  for (double& scale : scales.chains) scale *= pixels();
  for (double& scale : scales.samples) scale *= pixels() * allocation_.b0;
  Image image = chain_film_.image(scales.chains);
  image += sample_film_.image(scales.samples);
  return image;
}

Image MetropolisRendering::image() const {
  Image image = this->image(combination().mean());
  if (direct_.rendering) image += direct_.rendering->image();
  return image;
}

GroupImage MetropolisRendering::group(int index) const {
  const GroupCombination groups = combination();
  const MeanSums& b = groups.sums(index).brightness;
  return {image(groups.group(index)), groups.begun(index) ? 1.0 : 0.0, b.mean(),
          std::sqrt(b.variance_of_mean())};
}

/// Of all chains; `stuck` becomes the one that has stood still for longest.
ChainStats MetropolisRendering::sum_of_stats(StuckChain& stuck) const {
  ChainStats sum;
  sum.rows.resize(algorithm_->rows().size());
  sum.rays = bootstrap_rays_;
  for (size_t i = 0; i < shares_.size(); ++i) {
    const std::lock_guard lock(shares_[i]->mutex);
    if (const auto& samples = shares_[i]->samples) {
      sum.rays += samples->rays();
      sum.invalid += samples->invalid();
      continue;
    }
    const ChainStats& s = shares_[i]->chain->stats();
    for (size_t r = 0; r < sum.rows.size(); ++r) sum.rows[r] += s.rows[r];
    sum.rays += s.rays;
    sum.invalid += s.invalid;
    if (s.longest.rejections > stuck.rejections)
      stuck = {i, s.longest.rejections, s.longest.raster.x, s.longest.raster.y,
               s.longest.signature};
  }
  return sum;
}

void MetropolisRendering::add_stats(Stats& stats) const {
  const GroupCombination groups = combination();
  stats.b = groups.sums().brightness.mean();
  stats.b_error = std::sqrt(groups.sums().brightness.variance_of_mean());
  stats.independent_share = allocation_.share;
  stats.independent_samples = groups.sums().count();
  stats.samples_carrying_half = groups.sums().classes.carrying_half();

  StuckChain stuck;
  const ChainStats sum = sum_of_stats(stuck);
  if (stuck.rejections > 0) stats.stuck = {stuck};
  stats.invalid_samples += sum.invalid;
  stats.rays_intersect = sum.rays.intersect;
  stats.rays_occluded = sum.rays.occluded;
  const std::vector<MutationStats> names = algorithm_->rows();
  for (size_t r = 0; r < sum.rows.size(); ++r) {
    const ChainStats::Row& row = sum.rows[r];
    if (row.proposed == 0) continue;
    MutationStats m = names[r];
    const double n = static_cast<double>(row.proposed);
    m.proposed = row.proposed;
    m.generated = row.generated;
    m.accepted = row.accepted;
    m.rays = row.rays;
    m.mean_acceptance = row.acceptance / n;
    m.image_distance = row.image_distance / n;
    stats.mutations.push_back(m);
  }
  if (chain_film_.saturated() + sample_film_.saturated() > 0)
    stats.warnings.push_back(
        "the film's fixed-point range was exceeded; the brightest pixels are wrong");
}

}  // namespace mlt
