// A render of chains and samples as bytes, in checkpoints and for other machines. A chain's state
// replaces the one before; what chains have recorded is added: fixed-point sums do not depend on
// their order.
#include "integrator/metropolis_rendering.h"

namespace mlt {
namespace {

/// Groups that are saved with some chains: first ... last - 1.
struct GroupRange {
  int first, last;
};

}  // namespace

/// What is known before the first unit.
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
  const uint64_t before = sample_shares(), all = chains_.size();
  save_chains({std::clamp(task.shares.first, before, before + all) - before,
               std::clamp(task.shares.last, before, before + all) - before},
              content, bytes);
  bytes.write(direct_.rendering && content == Content::everything ? direct_.rendering->save()
                                                                  : std::string());
  return bytes.take();
}

void MetropolisRendering::save_chains(const Shares& shares, Content content,
                                      ByteWriter& bytes) const {
  bytes.write(shares);
  for (uint64_t i = shares.first; i < shares.last; ++i) {
    const ChainShare& share = *chains_[i];
    const std::lock_guard lock(share.mutex);
    bytes.write(share.units);
    bytes.write(share.brightness);
    share.chain->save(bytes);
  }
  GroupRange groups{0, 0};
  if (content != Content::task && shares.first < shares.last)
    groups = {chains_[shares.first]->group, chains_[shares.last - 1]->group + 1};
  bytes.write(groups);
  for (int g = groups.first; g < groups.last; ++g) bytes.write(groups_[g].steps.load());
  bytes.write(content != Content::task ? film_.save(groups.first, groups.last) : std::string());
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
  const auto shares = bytes.read<Shares>();
  if (shares.last > chains_.size()) throw RenderError("the saved state has too many chains");
  struct Loaded {
    uint64_t units;
    double brightness;
    std::unique_ptr<RenderChain> chain;
  };
  std::vector<Loaded> chains;
  for (uint64_t i = shares.first; i < shares.last; ++i) {
    const auto units = bytes.read<uint64_t>();
    const auto brightness = bytes.read<double>();
    chains.push_back({units, brightness, algorithm_->blank(chain_id(*chains_[i]))});
    chains.back().chain->load(bytes);
  }
  const auto groups = bytes.read<GroupRange>();
  if (groups.first < 0 || groups.last > group_count)
    throw RenderError("the saved state is damaged");
  std::vector<uint64_t> steps;
  for (int g = groups.first; g < groups.last; ++g) steps.push_back(bytes.read<uint64_t>());
  std::string film;
  bytes.read(film);
  if (!film.empty()) film_.merge(groups.first, groups.last, film);
  for (size_t i = 0; i < steps.size(); ++i) groups_[groups.first + i].steps += steps[i];
  for (uint64_t i = shares.first; i < shares.last; ++i) {
    ChainShare& share = *chains_[i];
    Loaded& from = chains[i - shares.first];
    const std::lock_guard lock(share.mutex);
    share.units = from.units;
    share.brightness = from.brightness;
    share.chain = std::move(from.chain);
  }
}

}  // namespace mlt
