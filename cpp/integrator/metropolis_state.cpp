// Chains as bytes, in checkpoints and for other machines. A chain's state replaces the one before;
// what chains have recorded is added: fixed-point sums do not depend on their order.
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
  for (const Group& group : groups_) {
    bytes.write(group.b);
    bytes.write(group.b_error);
  }
  bytes.write(bootstrap_rays_);
  bytes.write(algorithm_->save());
  return bytes.take();
}

void MetropolisRendering::load_prepared(const std::string& prepared) {
  ByteReader bytes(prepared);
  for (Group& group : groups_) {
    group.b = bytes.read<double>();
    group.b_error = bytes.read<double>();
  }
  bootstrap_rays_ = bytes.read<RayCounts>();
  std::string algorithm;
  bytes.read(algorithm);
  bytes.finish();
  algorithm_->load(algorithm);
  lay_out();
}

std::string MetropolisRendering::save(const Task& task, Content content) const {
  const Shares shares{task.shares.first, std::min<uint64_t>(task.shares.last, chains_.size())};
  ByteWriter bytes;
  bytes.write(shares);
  bytes.write(content != Content::result ? save_prepared() : std::string());
  for (uint64_t i = shares.first; i < shares.last; ++i) {
    const std::lock_guard lock(chains_[i]->mutex);
    bytes.write(chains_[i]->units);
    chains_[i]->chain->save(bytes);
  }
  GroupRange groups{0, 0};
  if (content != Content::task && shares.first < shares.last)
    groups = {chains_[shares.first]->group, chains_[shares.last - 1]->group + 1};
  bytes.write(groups);
  for (int g = groups.first; g < groups.last; ++g) bytes.write(groups_[g].steps.load());
  bytes.write(content != Content::task ? film_.save(groups.first, groups.last) : std::string());
  bytes.write(direct_.rendering && content == Content::everything ? direct_.rendering->save()
                                                                  : std::string());
  return bytes.take();
}

void MetropolisRendering::load(const std::string& state) {
  ByteReader bytes(state);
  std::string prepared, film, direct;
  const auto shares = bytes.read<Shares>();
  bytes.read(prepared);
  if (!prepared.empty()) load_prepared(prepared);
  if (shares.last > chains_.size()) throw RenderError("the saved state has too many chains");
  struct Loaded {
    uint64_t units;
    std::unique_ptr<RenderChain> chain;
  };
  std::vector<Loaded> chains;
  for (uint64_t i = shares.first; i < shares.last; ++i) {
    const auto units = bytes.read<uint64_t>();
    chains.push_back({units, algorithm_->blank(chain_id(*chains_[i]))});
    chains.back().chain->load(bytes);
  }
  const auto groups = bytes.read<GroupRange>();
  if (groups.first < 0 || groups.last > group_count)
    throw RenderError("the saved state is damaged");
  std::vector<uint64_t> steps;
  for (int g = groups.first; g < groups.last; ++g) steps.push_back(bytes.read<uint64_t>());
  bytes.read(film);
  bytes.read(direct);
  bytes.finish();
  if (!film.empty()) film_.merge(groups.first, groups.last, film);
  for (size_t i = 0; i < steps.size(); ++i) groups_[groups.first + i].steps += steps[i];
  if (direct_.rendering && !direct.empty()) direct_.rendering->load(direct);
  for (uint64_t i = shares.first; i < shares.last; ++i) {
    ChainShare& share = *chains_[i];
    const std::lock_guard lock(share.mutex);
    share.chain = std::move(chains[i - shares.first].chain);
    share.units = chains[i - shares.first].units;
  }
}

}  // namespace mlt
