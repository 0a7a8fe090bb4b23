// Chains on other machines. A chain's state travels there and back; what it has recorded meanwhile comes
// back as a film of its own, which is added: fixed-point sums do not depend on their order.
#include "integrator/metropolis_rendering.h"

#include <algorithm>

namespace mlt {

std::vector<Part> MetropolisRendering::parts(int wanted) const {
  const int per_group = std::max(1, (wanted + groups - 1) / groups);
  std::vector<Part> parts;
  for (uint64_t begin = 0, end = 0; begin < lanes_.size(); begin = end) {
    while (end < lanes_.size() && lanes_[end]->group == lanes_[begin]->group) ++end;
    const uint64_t chains = end - begin, pieces = std::min<uint64_t>(per_group, chains);
    for (uint64_t i = 0; i < pieces; ++i)
      parts.push_back({begin + chains * i / pieces, begin + chains * (i + 1) / pieces});
  }
  return parts;
}

std::string MetropolisRendering::lend(const Work& work) const {
  ByteWriter bytes;
  bytes.write(algorithm_->save());
  bytes.write<uint64_t>(lanes_.size());
  for (uint64_t i = work.part.first; i < work.part.last; ++i) {
    const std::lock_guard lock(lanes_[i]->mutex);
    save_lane(bytes, *lanes_[i]);
  }
  return bytes.take();
}

void MetropolisRendering::borrow(const Work& work, const std::string& lent) {
  ByteReader bytes(lent);
  std::string prepared;
  bytes.read(prepared);
  algorithm_->load(prepared);
  const uint64_t lanes = bytes.read<uint64_t>();
  if (lanes > static_cast<uint64_t>(settings_.chains) || work.part.last > lanes)
    throw RenderError("the part of the render has too many chains");
  lanes_.resize(lanes);
  for (uint64_t i = work.part.first; i < work.part.last; ++i) lanes_[i] = load_lane(bytes);
  bytes.finish();
}

std::string MetropolisRendering::give_back(const Work& work) const {
  const int group = lanes_[work.part.first]->group;
  ByteWriter bytes;
  for (uint64_t i = work.part.first; i < work.part.last; ++i) save_lane(bytes, *lanes_[i]);
  bytes.write(groups_[group].steps.load());
  bytes.write(film_.save_groups(group, group + 1));
  return bytes.take();
}

void MetropolisRendering::take_back(const Work& work, const std::string& given_back) {
  const int group = lanes_[work.part.first]->group;
  ByteReader bytes(given_back);
  std::vector<std::unique_ptr<Lane>> lanes;
  for (uint64_t i = work.part.first; i < work.part.last; ++i) {
    lanes.push_back(load_lane(bytes));
    if (lanes.back()->group != group)
      throw RenderError("the part of the render has chains of other groups");
  }
  const auto steps = bytes.read<uint64_t>();
  std::string film;
  bytes.read(film);
  bytes.finish();
  film_.add_groups(group, group + 1, film);
  groups_[group].steps += steps;
  for (uint64_t i = work.part.first; i < work.part.last; ++i) {
    Lane &to = *lanes_[i], &from = *lanes[i - work.part.first];
    const std::lock_guard lock(to.mutex);
    to.chain = std::move(from.chain);
    to.round = from.round;
  }
}

}  // namespace mlt
