// A render of chains and samples as bytes, in checkpoints and for other machines. A chain's state
// replaces the one before; the sums that chains have recorded are added: fixed-point sums do not
// depend on their order.
#include "rendering/metropolis_rendering.h"

namespace mlt {
namespace {

/// Groups that are saved with some chains: first ... last - 1.
struct GroupRange {
  int first, last;
};

}  // namespace

/// Saves the results of the preparation, which are known before the first unit.
std::string MetropolisRendering::save_prepared() const {
  ByteWriter bytes;
  bytes.write(allocation_);
  for (const Group& group : groups_) {
    bytes.write(group.b);
    group.bootstrap.save(bytes);
  }
  bytes.write(bootstrap_rays_);
  bytes.write(algorithm_->save());
  return bytes.take();
}

void MetropolisRendering::load_prepared(const std::string& prepared) {
  ByteReader bytes(prepared);
  allocation_ = bytes.read<Allocation>();
  if (!(0 <= allocation_.share && allocation_.share <= 1 && 0 < allocation_.mutations_per_sample &&
        allocation_.mutations_per_sample < 1e6 && 0 < allocation_.steps_per_start &&
        0 < allocation_.kappa0))
    throw RenderError("the saved state divides the time as no render does");
  if (!algorithm_->set_techniques(allocation_.techniques))
    throw RenderError("the saved state has techniques that do not exist");
  for (Group& group : groups_) {
    group.b = bytes.read<double>();
    group.bootstrap.load(bytes);
  }
  bootstrap_rays_ = bytes.read<RayCounts>();
  std::string algorithm;
  bytes.read(algorithm);
  bytes.finish();
  algorithm_->load(algorithm);
  algorithm_->set_weights(allocation_.weights);
  lay_out();
}

std::string MetropolisRendering::save(const Task& task, Content content) const {
  ByteWriter bytes;
  bytes.write(content != Content::result ? save_prepared() : std::string());
  std::string samples;
  if (samples_) {
    Task own = task;
    own.from = interleaving_.sampled_before(task.from);
    if (task.to != Task().to) own.to = interleaving_.sampled_before(task.to);
    samples = samples_->save(own, content);
  }
  bytes.write(samples);
  const uint64_t before = sample_strands(), all = teams_.size();
  save_chains({std::clamp(task.strands.first, before, before + all) - before,
               std::clamp(task.strands.last, before, before + all) - before},
              content, bytes);
  bytes.write(direct_.rendering && content == Content::everything ? direct_.rendering->save()
                                                                  : std::string());
  return bytes.take();
}

void MetropolisRendering::save_chains(const Strands& strands, Content content,
                                      ByteWriter& bytes) const {
  bytes.write(strands);
  for (uint64_t i = strands.first; i < strands.last; ++i) {
    const ChainBatch& team = *teams_[i];
    const std::lock_guard lock(team.mutex);
    bytes.write(team.units);
    bytes.write(team.brightness);
    for (const auto& chain : team.chains) chain->save(bytes);
  }
  GroupRange groups{0, 0};
  if (content != Content::task && strands.first < strands.last)
    groups = {teams_[strands.first]->group, teams_[strands.last - 1]->group + 1};
  bytes.write(groups);
  for (int g = groups.first; g < groups.last; ++g) bytes.write(groups_[g].steps.load());
  const bool sums = content != Content::task;
  bytes.write(sums ? film_.save(groups.first, groups.last) : std::string());
  for (const auto& film : light_films_)
    bytes.write(sums ? film->save(groups.first, groups.last) : std::string());
}

void MetropolisRendering::load(const std::string& state) {
  ByteReader bytes(state);
  std::string prepared, samples, direct;
  bytes.read(prepared);
  bytes.read(samples);
  if (!prepared.empty()) load_prepared(prepared);
  load_chains(bytes);
  bytes.read(direct);
  bytes.finish();
  if (samples_ && !samples.empty()) samples_->load(samples);
  if (direct_.rendering && !direct.empty()) direct_.rendering->load(direct);
}

void MetropolisRendering::load_chains(ByteReader& bytes) {
  const auto strands = bytes.read<Strands>();
  if (strands.last > teams_.size()) throw RenderError("the saved state has too many chains");
  struct Loaded {
    uint64_t units;
    double brightness;
    std::vector<std::unique_ptr<RenderChain>> chains;
  };
  std::vector<Loaded> teams;
  for (uint64_t i = strands.first; i < strands.last; ++i) {
    const auto units = bytes.read<uint64_t>();
    const auto brightness = bytes.read<double>();
    teams.push_back({units, brightness, {}});
    for (size_t k = 0; k < teams_[i]->chains.size(); ++k) {
      teams.back().chains.push_back(blank_chain(*teams_[i], k));
      teams.back().chains.back()->load(bytes);
    }
  }
  const auto groups = bytes.read<GroupRange>();
  if (groups.first < 0 || groups.last > group_count)
    throw RenderError("the saved state is damaged");
  std::vector<uint64_t> steps;
  for (int g = groups.first; g < groups.last; ++g) steps.push_back(bytes.read<uint64_t>());
  std::string film;
  bytes.read(film);
  std::vector<std::string> light(light_films_.size());
  for (std::string& light_film : light) bytes.read(light_film);
  if (!film.empty()) film_.merge(groups.first, groups.last, film);
  for (size_t i = 0; i < light.size(); ++i)
    if (!light[i].empty()) light_films_[i]->merge(groups.first, groups.last, light[i]);
  for (size_t i = 0; i < steps.size(); ++i) groups_[groups.first + i].steps += steps[i];
  for (uint64_t i = strands.first; i < strands.last; ++i) {
    ChainBatch& team = *teams_[i];
    Loaded& from = teams[i - strands.first];
    const std::lock_guard lock(team.mutex);
    team.units = from.units;
    team.brightness = from.brightness;
    team.chains = std::move(from.chains);
  }
}

}  // namespace mlt
