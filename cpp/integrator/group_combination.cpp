#include "integrator/group_combination.h"

namespace mlt {

GroupCombination::GroupCombination(std::vector<GroupProgress> groups) : groups_(std::move(groups)) {
  for (int g = 0; g < count(); ++g) {
    own_.push_back(groups_[g].bootstrap);
    own_.back() += groups_[g].samples;
    all_ += own_.back();
    chain_brightness_ += chain_brightness(g);
    has_samples_ |= groups_[g].samples.count() > 0;
  }
}

/// b_g D_g; 0 without chains.
double GroupCombination::chain_brightness(int g) const {
  return has_chains(g) ? b(g) * groups_[g].brightness / static_cast<double>(groups_[g].steps) : 0.0;
}

bool GroupCombination::begun(int g) const {
  const bool waits_for_chains = b(g) > 0 && !has_chains(g);
  const bool waits_for_samples = has_samples_ && groups_[g].samples.count() == 0;
  return !waits_for_chains && !waits_for_samples;
}

GroupScales GroupCombination::group(int g) const {
  const GroupProgress& own = groups_[g];
  GroupScales scales{std::vector<double>(count()), std::vector<double>(count())};
  if (own.samples.count() > 0) scales.samples[g] = 1 / static_cast<double>(own.samples.count());
  const double others = chain_brightness_ - chain_brightness(g);
  const double missing = own_[g].of_chains.mean() - chain_brightness(g);
  for (int h = 0; h < count(); ++h)
    if (has_chains(h)) {
      const double factor = h == g ? 1.0 : others > 0 ? missing / others : 0.0;
      scales.chains[h] = factor * b(h) / static_cast<double>(groups_[h].steps);
    }
  return scales;
}

GroupScales GroupCombination::mean() const {
  GroupScales mean{std::vector<double>(count()), std::vector<double>(count())};
  int begun_groups = 0;
  for (int g = 0; g < count(); ++g) begun_groups += begun(g);
  for (int g = 0; g < count(); ++g) {
    if (!begun(g)) continue;
    const GroupScales own = group(g);
    for (int h = 0; h < count(); ++h) {
      mean.chains[h] += own.chains[h] / begun_groups;
      mean.samples[h] += own.samples[h] / begun_groups;
    }
  }
  return mean;
}

}  // namespace mlt
