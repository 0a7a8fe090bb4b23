#include "integrator/metropolis_rendering.h"

#include "base/parallel.h"
#include "markov/bootstrap.h"

#include <algorithm>
#include <cmath>

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
            scene_->film().filter, group_count),
      steps_per_unit_(std::min(most_steps_per_unit,
                               static_cast<uint64_t>(std::ceil(pixels() / settings.chains)))) {}

int MetropolisRendering::chains_of(int group) const {
  return (settings_.chains + group_count - 1 - group) / group_count;
}

ChainId MetropolisRendering::chain_id(const ChainShare& share) const {
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
  algorithm_->prepare(seed_, threads, cancelled);
  const uint64_t per_group = (settings_.luminance_samples + group_count - 1) / group_count;
  const Candidates candidates{seed_, Purpose::bootstrap, per_group * group_count};
  const std::vector<double> weights = candidate_weights(
      candidates, threads, cancelled, [&] { return algorithm_->source(); },
      [&](const MetropolisAlgorithm::Source& source) { bootstrap_rays_ += source.rays(); });
  if (cancelled) return;

  std::vector<std::vector<uint32_t>> seeds(group_count);
  for (int g = 0; g < group_count; ++g) {
    Rng rng(seed_, Purpose::resample, g);
    const auto first = weights.begin() + g * per_group;
    Bootstrap bootstrap = resample({first, first + per_group}, chains_of(g), rng);
    groups_[g].b = bootstrap.b;
    groups_[g].b_error = bootstrap.b_error;
    seeds[g] = std::move(bootstrap.seeds);
  }
  lay_out();
  if (chains_.empty())
    throw RenderError(
        "no light path was found among " + std::to_string(candidates.count) +
        " bootstrap samples; give more luminance_samples, or check that light can reach "
        "the camera");
  parallel_for(threads, chains_.size(), [&](uint64_t i) {
    ChainShare& share = *chains_[i];
    const uint64_t candidate = share.group * per_group + seeds[share.group][share.number];
    share.chain =
        algorithm_->start(chain_id(share), candidates.rng(candidate),
                          Rng(seed_, Purpose::choice,
                              static_cast<uint64_t>(share.number) * group_count + share.group));
  });
}

/// Which chains there are, once b of each group is known.
void MetropolisRendering::lay_out() {
  chains_.clear();
  plan_.borders = {0};
  for (int g = 0; g < group_count; ++g) {
    for (int number = 0; groups_[g].b > 0 && number < chains_of(g); ++number) {
      chains_.push_back(std::make_unique<ChainShare>());
      chains_.back()->group = g;
      chains_.back()->number = number;
    }
    if (chains_.size() > plan_.borders.back()) plan_.borders.push_back(chains_.size());
  }
  plan_.units_per_pass = plan_.units_per_group_turn = chains_.size();
  plan_.samples_per_pass = static_cast<double>(chains_.size() * steps_per_unit_);
  plan_.pixels = pixels();
}

void MetropolisRendering::run_unit(uint64_t unit) {
  ChainShare& share = *chains_[unit % chains_.size()];
  const uint64_t units_before = unit / chains_.size();
  std::unique_lock lock(share.mutex);
  share.turn.wait(lock, [&] { return share.units >= units_before; });
  if (share.units > units_before) return;
  // Whatever happens, the thread that waits for the chain's next unit must go on.
  struct Done {
    ChainShare& share;
    ~Done() {
      ++share.units;
      share.turn.notify_all();
    }
  } done{share};
  ChainRecorder recorder(film_, share.group);
  share.chain->advance(steps_per_unit_, recorder);
  groups_[share.group].steps += steps_per_unit_;
}

/// I_j = b E[h_j RGB / L*] per unit of image area: the group's own b_g times its mean.
double MetropolisRendering::scale_of(const Group& group) const {
  const uint64_t steps = group.steps;
  return steps > 0 ? group.b * pixels() / static_cast<double>(steps) : 0.0;
}

/// The mean over the groups that have begun. A group whose bootstrap found no light rightly
/// contributes 0.
Image MetropolisRendering::image() const {
  int count = 0;
  std::vector<double> scale(group_count, 0.0);
  for (int g = 0; g < group_count; ++g) {
    scale[g] = scale_of(groups_[g]);
    count += begun(groups_[g]);
  }
  for (double& s : scale) s /= std::max(1, count);
  Image image = film_.image(scale);
  if (!direct_.rendering) return image;
  const Image other = direct_.rendering->image();
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] += other.data[i];
  return image;
}

GroupImage MetropolisRendering::group(int index) const {
  const Group& group = groups_[index];
  std::vector<double> scale(group_count, 0.0);
  scale[index] = scale_of(group);
  return {film_.image(scale), begun(group) ? 1.0 : 0.0, group.b, group.b_error};
}

/// Of all chains; `stuck` becomes the one that has stood still for longest.
ChainStats MetropolisRendering::sum_of_stats(StuckChain& stuck) const {
  ChainStats sum;
  sum.rows.resize(algorithm_->rows().size());
  sum.rays = bootstrap_rays_;
  for (size_t i = 0; i < chains_.size(); ++i) {
    const std::lock_guard lock(chains_[i]->mutex);
    const ChainStats& s = chains_[i]->chain->stats();
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
  double b = 0, variance = 0;
  for (const Group& group : groups_) {
    b += group.b;
    variance += sqr(group.b_error);
  }
  stats.b = b / group_count;
  stats.b_error = std::sqrt(variance) / group_count;

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
  algorithm_->add_stats(stats);
  if (film_.saturated() > 0)
    stats.warnings.push_back(
        "the film's fixed-point range was exceeded; the brightest pixels are wrong");
}

}  // namespace mlt
