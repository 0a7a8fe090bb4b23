#include "integrator/metropolis_rendering.h"

#include "base/parallel.h"
#include "markov/bootstrap.h"

#include <algorithm>
#include <cmath>

namespace mlt {

MetropolisRendering::MetropolisRendering(ScenePtr scene, uint64_t seed,
                                         const MetropolisSettings& settings,
                                         std::unique_ptr<MetropolisAlgorithm> algorithm,
                                         Aside aside)
    : scene_(std::move(scene)),
      seed_(seed),
      settings_(settings),
      algorithm_(std::move(algorithm)),
      aside_(std::move(aside)),
      film_(scene_->camera().raster().size.x, scene_->camera().raster().size.y,
            scene_->film().filter, groups),
      groups_(groups),
      steps_per_unit_(std::min(most_steps_per_unit,
                               static_cast<uint64_t>(std::ceil(pixels() / settings.chains)))) {}

int MetropolisRendering::chains_of(int group) const {
  return (settings_.chains + groups - 1 - group) / groups;
}

void MetropolisRendering::render_aside(int threads, const std::atomic<bool>& cancelled) {
  Rendering& aside = *aside_.rendering;
  aside.prepare(threads, cancelled);
  parallel_for(threads, aside.unit_count(aside_.spp), [&](uint64_t unit) {
    if (!cancelled) aside.run_unit(unit);
  });
}

void MetropolisRendering::prepare(int threads, const std::atomic<bool>& cancelled) {
  if (aside_.rendering) render_aside(threads, cancelled);
  algorithm_->prepare(seed_, threads, cancelled);
  const uint64_t per_group = (settings_.luminance_samples + groups - 1) / groups;
  const Candidates candidates{seed_, Purpose::bootstrap, per_group * groups};
  const std::vector<double> weights = candidate_weights(
      candidates, threads, cancelled, [&] { return algorithm_->source(); },
      [&](const MetropolisAlgorithm::Source& source) { bootstrap_rays_ += source.rays(); });
  if (cancelled) return;

  std::vector<std::vector<uint32_t>> seeds(groups);
  for (int g = 0; g < groups; ++g) {
    Rng rng(seed_, Purpose::resample, g);
    const auto first = weights.begin() + g * per_group;
    Bootstrap bootstrap = resample({first, first + per_group}, chains_of(g), rng);
    groups_[g].b = bootstrap.b;
    groups_[g].b_error = bootstrap.b_error;
    seeds[g] = std::move(bootstrap.seeds);
  }
  struct Start {
    int group, number;
    uint64_t candidate;
  };
  std::vector<Start> starts;
  // Group after group: the film of one group then stays in the cache while its chains advance.
  for (int g = 0; g < groups; ++g)
    for (int number = 0; number < static_cast<int>(seeds[g].size()); ++number)
      starts.push_back({g, number, g * per_group + seeds[g][number]});
  if (starts.empty())
    throw RenderError(
        "no light path was found among " + std::to_string(candidates.count) +
        " bootstrap samples; give more luminance_samples, or check that light can reach "
        "the camera");
  lanes_.resize(starts.size());
  parallel_for(threads, starts.size(), [&](uint64_t i) {
    const auto [group, number, candidate] = starts[i];
    lanes_[i] = std::make_unique<Lane>();
    lanes_[i]->group = group;
    lanes_[i]->number = number;
    lanes_[i]->chain = algorithm_->start(
        chain_id(group, number), candidates.rng(candidate),
        Rng(seed_, Purpose::choice, static_cast<uint64_t>(number) * groups + group));
  });
}

uint64_t MetropolisRendering::unit_count(double spp) const {
  const double per_round = static_cast<double>(lanes_.size() * steps_per_unit_);
  return static_cast<uint64_t>(std::ceil(spp * pixels() / per_round)) * lanes_.size();
}

double MetropolisRendering::spp_done(uint64_t units) const {
  return static_cast<double>(units * steps_per_unit_) / pixels();
}

void MetropolisRendering::run_unit(uint64_t unit) {
  Lane& lane = *lanes_[unit % lanes_.size()];
  const uint64_t round = unit / lanes_.size();
  std::unique_lock lock(lane.mutex);
  lane.turn.wait(lock, [&] { return lane.round >= round; });
  if (lane.round > round) return;
  // Whatever happens, the thread that waits for the next stretch must go on.
  struct Done {
    Lane& lane;
    ~Done() {
      ++lane.round;
      lane.turn.notify_all();
    }
  } done{lane};
  ChainRecorder recorder(film_, lane.group);
  lane.chain->advance(steps_per_unit_, recorder);
  groups_[lane.group].steps += steps_per_unit_;
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
  std::vector<double> scale(groups, 0.0);
  for (int g = 0; g < groups; ++g) {
    scale[g] = scale_of(groups_[g]);
    count += begun(groups_[g]);
  }
  for (double& s : scale) s /= std::max(1, count);
  Image image = film_.image(scale);
  if (!aside()) return image;
  const Image other = aside()->image();
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] += other.data[i];
  return image;
}

GroupImage MetropolisRendering::group(int index) const {
  const Group& group = groups_[index];
  std::vector<double> scale(groups, 0.0);
  scale[index] = scale_of(group);
  return {film_.image(scale), begun(group) ? 1.0 : 0.0, group.b, group.b_error};
}

void MetropolisRendering::add_stats(Stats& stats) const {
  double sum = 0, variance = 0;
  for (const Group& group : groups_) {
    sum += group.b;
    variance += sqr(group.b_error);
  }
  stats.b = sum / groups;
  stats.b_error = std::sqrt(variance) / groups;

  std::vector<MutationStats> names = algorithm_->rows();
  std::vector<ChainStats::Row> rows(names.size());
  RayCounts rays = bootstrap_rays_;
  StuckChain stuck;
  for (size_t i = 0; i < lanes_.size(); ++i) {
    const Lane& lane = *lanes_[i];
    const std::lock_guard lock(lane.mutex);
    const ChainStats& s = lane.chain->stats();
    for (size_t r = 0; r < rows.size(); ++r) rows[r] += s.rows[r];
    rays += s.rays;
    stats.invalid_samples += s.invalid;
    if (s.longest.rejections > stuck.rejections)
      stuck = {i, s.longest.rejections, s.longest.raster.x, s.longest.raster.y,
               s.longest.signature};
  }
  stats.rays_intersect = rays.intersect;
  stats.rays_occluded = rays.occluded;
  for (size_t r = 0; r < rows.size(); ++r) {
    if (rows[r].proposed == 0) continue;
    MutationStats& m = names[r];
    const double n = static_cast<double>(rows[r].proposed);
    m.proposed = rows[r].proposed;
    m.generated = rows[r].generated;
    m.accepted = rows[r].accepted;
    m.rays = rows[r].rays;
    m.mean_acceptance = rows[r].acceptance / n;
    m.image_distance = rows[r].image_distance / n;
    stats.mutations.push_back(m);
  }
  if (stuck.rejections > 0) stats.stuck = {stuck};
  algorithm_->add_stats(stats);
  if (film_.saturated() > 0)
    stats.warnings.push_back(
        "the film's fixed-point range was exceeded; the brightest pixels are wrong");
}

void MetropolisRendering::save_lane(ByteWriter& bytes, const Lane& lane) const {
  bytes.write(lane.group);
  bytes.write(lane.number);
  bytes.write(lane.round);
  lane.chain->save(bytes);
}

std::unique_ptr<MetropolisRendering::Lane> MetropolisRendering::load_lane(ByteReader& bytes) const {
  auto lane = std::make_unique<Lane>();
  lane->group = bytes.read<int>();
  if (lane->group < 0 || lane->group >= groups) throw RenderError("the saved state is damaged");
  lane->number = bytes.read<int>();
  lane->round = bytes.read<uint64_t>();
  lane->chain = algorithm_->blank(chain_id(lane->group, lane->number));
  lane->chain->load(bytes);
  return lane;
}

std::string MetropolisRendering::save() const {
  ByteWriter bytes;
  for (const Group& group : groups_) {
    bytes.write(group.b);
    bytes.write(group.b_error);
    bytes.write(group.steps.load());
  }
  bytes.write(bootstrap_rays_);
  bytes.write(algorithm_->save());
  bytes.write<uint64_t>(lanes_.size());
  for (const auto& lane : lanes_) save_lane(bytes, *lane);
  bytes.write(aside() ? aside()->save() : std::string());
  bytes.write(film_.save());
  return bytes.take();
}

void MetropolisRendering::load(const std::string& saved) {
  ByteReader bytes(saved);
  for (Group& group : groups_) {
    group.b = bytes.read<double>();
    group.b_error = bytes.read<double>();
    group.steps = bytes.read<uint64_t>();
  }
  bootstrap_rays_ = bytes.read<RayCounts>();
  std::string prepared;
  bytes.read(prepared);
  algorithm_->load(prepared);
  const uint64_t lanes = bytes.read<uint64_t>();
  if (lanes > static_cast<uint64_t>(settings_.chains))
    throw RenderError("the saved state has too many chains");
  lanes_.clear();
  for (uint64_t i = 0; i < lanes; ++i) lanes_.push_back(load_lane(bytes));
  std::string other;
  bytes.read(other);
  if (aside()) aside_.rendering->load(other);
  std::string film;
  bytes.read(film);
  film_.load(film);
  bytes.finish();
}

}  // namespace mlt
