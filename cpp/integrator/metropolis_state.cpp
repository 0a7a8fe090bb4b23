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
  bytes.write(allocation_);
  for (const Group& group : groups_) group.bootstrap.save(bytes);
  bytes.write(bootstrap_rays_);
  bytes.write(algorithm_->save());
  return bytes.take();
}

void MetropolisRendering::load_prepared(const std::string& prepared) {
  ByteReader bytes(prepared);
  allocation_ = bytes.read<Allocation>();
  for (Group& group : groups_) group.bootstrap.load(bytes);
  bootstrap_rays_ = bytes.read<RayCounts>();
  std::string algorithm;
  bytes.read(algorithm);
  bytes.finish();
  algorithm_->load(algorithm);
  lay_out();
}

std::string MetropolisRendering::save(const Task& task, Content content) const {
  const Shares shares{task.shares.first, std::min<uint64_t>(task.shares.last, shares_.size())};
  ByteWriter bytes;
  bytes.write(shares);
  bytes.write(content != Content::result ? save_prepared() : std::string());
  for (uint64_t i = shares.first; i < shares.last; ++i) {
    const Share& share = *shares_[i];
    const std::lock_guard lock(share.mutex);
    bytes.write(share.units);
    bytes.write(share.brightness);
    share.samples ? share.samples->save(bytes) : share.chain->save(bytes);
  }
  GroupRange groups{0, 0};
  if (content != Content::task && shares.first < shares.last)
    groups = {shares_[shares.first]->group, shares_[shares.last - 1]->group + 1};
  bytes.write(groups);
  for (int g = groups.first; g < groups.last; ++g) bytes.write(groups_[g].steps.load());
  for (const SplatFilm* film : {&chain_film_, &sample_film_})
    bytes.write(content != Content::task ? film->save(groups.first, groups.last) : std::string());
  bytes.write(direct_.rendering && content == Content::everything ? direct_.rendering->save()
                                                                  : std::string());
  return bytes.take();
}

/// The work of a share as it was saved.
std::unique_ptr<MetropolisRendering::Share> MetropolisRendering::read_share(
    const Share& like, ByteReader& bytes) const {
  auto share = std::make_unique<Share>();
  share->group = like.group;
  share->number = like.number;
  share->units = bytes.read<uint64_t>();
  share->brightness = bytes.read<double>();
  if (like.samples) {
    share->samples = samples_of(like.group, like.number);
    share->samples->load(bytes);
  } else {
    share->chain = algorithm_->blank(chain_id(like));
    share->chain->load(bytes);
  }
  return share;
}

void MetropolisRendering::load(const std::string& state) {
  ByteReader bytes(state);
  std::string prepared, chain_film, sample_film, direct;
  const auto shares = bytes.read<Shares>();
  bytes.read(prepared);
  if (!prepared.empty()) load_prepared(prepared);
  if (shares.last > shares_.size()) throw RenderError("the saved state has too many chains");
  std::vector<std::unique_ptr<Share>> loaded;
  for (uint64_t i = shares.first; i < shares.last; ++i)
    loaded.push_back(read_share(*shares_[i], bytes));
  const auto groups = bytes.read<GroupRange>();
  if (groups.first < 0 || groups.last > group_count)
    throw RenderError("the saved state is damaged");
  std::vector<uint64_t> steps;
  for (int g = groups.first; g < groups.last; ++g) steps.push_back(bytes.read<uint64_t>());
  bytes.read(chain_film);
  bytes.read(sample_film);
  bytes.read(direct);
  bytes.finish();
  if (!chain_film.empty()) chain_film_.merge(groups.first, groups.last, chain_film);
  if (!sample_film.empty()) sample_film_.merge(groups.first, groups.last, sample_film);
  for (size_t i = 0; i < steps.size(); ++i) groups_[groups.first + i].steps += steps[i];
  if (direct_.rendering && !direct.empty()) direct_.rendering->load(direct);
  for (uint64_t i = shares.first; i < shares.last; ++i) {
    Share &share = *shares_[i], &from = *loaded[i - shares.first];
    const std::lock_guard lock(share.mutex);
    share.chain = std::move(from.chain);
    share.samples = std::move(from.samples);
    share.units = from.units;
    share.brightness = from.brightness;
  }
}

}  // namespace mlt
