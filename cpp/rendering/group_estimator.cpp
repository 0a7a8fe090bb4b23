#include "rendering/group_estimator.h"

#include "math/vec.h"

#include <algorithm>

namespace mlt {

GroupEstimator::GroupEstimator(std::vector<GroupProgress> groups, const Estimate& of_chains,
                               bool corrected)
    : groups_(std::move(groups)), of_chains_(of_chains) {
  MeanSums by_chains, bootstrap, due;
  for (int g = 0; g < count(); ++g) {
    chain_brightness_ += chain_brightness(g);
    if (begun(g)) by_chains.add(chain_brightness(g));
    if (has_chains(g))
      due.add(groups_[g].b * groups_[g].due / static_cast<double>(groups_[g].steps));
    bootstrap += groups_[g].bootstrap.of_chains;
  }
  const Estimate chains = estimate(by_chains), samples = pooled(estimate(bootstrap), of_chains_);
  mean_brightness_ = chains.mean;
  waiting_ = due.mean();
  if (chains.variance > 0 && samples.count > 0) {
    if (corrected) lambda_ = chains.variance / (chains.variance + samples.variance);
    const double difference = samples.mean - chains.mean;
    if (sqr(difference) > sqr(2.5) * (chains.variance + samples.variance))
      missing_ = (1 - lambda_) * difference;
  }
  if (std::abs(missing_) < waiting_) missing_ = waiting_;
}

/// The estimate M_g.
Estimate GroupEstimator::samples_of(int g) const {
  return pooled(estimate(groups_[g].bootstrap.of_chains), of_chains_);
}

/// The brightness b_g D_g of the chains of a group; 0 without chains.
double GroupEstimator::chain_brightness(int g) const {
  const GroupProgress& group = groups_[g];
  return has_chains(g) ? group.b * group.brightness / static_cast<double>(group.steps) : 0.0;
}

/// The correction of a group. It takes at most 1 / (count - 1) of the others' light from them.
GroupEstimator::Correction GroupEstimator::correction(int g) const {
  const double missing = lambda_ * (samples_of(g).mean - chain_brightness(g));
  const double others = chain_brightness_ - chain_brightness(g);
  if (!(others > 0)) return {0, std::min(0.0, missing)};
  const double of_others = std::max(missing, -others / (count() - 1));
  return {of_others, missing - of_others};
}

GroupWeights GroupEstimator::corrected(int g) const {
  const Correction add = correction(g);
  const double own = chain_brightness(g), others = chain_brightness_ - own;
  GroupWeights scales(count());
  for (int h = 0; h < count(); ++h) {
    if (!has_chains(h)) continue;
    const double factor = h != g    ? (others > 0 ? add.of_others / others : 0.0)
                          : own > 0 ? 1 + add.of_itself / own
                                    : 1.0;
    scales[h] = factor * groups_[h].b / static_cast<double>(groups_[h].steps);
  }
  return scales;
}

GroupWeights GroupEstimator::mean() const {
  GroupWeights mean(count());
  int begun_groups = 0;
  for (int g = 0; g < count(); ++g) begun_groups += begun(g);
  for (int g = 0; g < count(); ++g) {
    if (!begun(g)) continue;
    const GroupWeights own = corrected(g);
    for (int h = 0; h < count(); ++h) mean[h] += own[h] / begun_groups;
  }
  // A sum is negative if several groups are that bright.
  for (double& scale : mean) scale = std::max(0.0, scale);
  return mean;
}

GroupWeights GroupEstimator::mean_without(int g) const {
  std::vector<GroupProgress> others = groups_;
  others.erase(others.begin() + g);
  GroupWeights mean = GroupEstimator(std::move(others), of_chains_).mean();
  mean.insert(mean.begin() + g, 0.0);
  return mean;
}

GroupWeights GroupEstimator::group(int g) const {
  if (lambda_ == 0) return corrected(g);
  std::vector<int> begun_groups;
  for (int h = 0; h < count(); ++h)
    if (begun(h)) begun_groups.push_back(h);
  const double n = static_cast<double>(begun_groups.size());
  GroupWeights scales = mean();
  for (const int h : begun_groups) {
    const GroupWeights without = mean_without(h);
    for (int i = 0; i < count(); ++i) scales[i] += (n - 1) * (1 / n - (h == g)) * without[i];
  }
  return scales;
}

double GroupEstimator::excess() const {
  return mean_brightness_ > 0 ? std::max(0.0, std::abs(missing_) / mean_brightness_ - 1) : 0;
}

GroupWeights GroupEstimator::common_error() const {
  GroupWeights scales(count());
  if (!(chain_brightness_ > 0)) return scales;
  const double placed = std::abs(missing_) / (1 + excess());
  double error = placed;
  if (of_chains_.count > 0) {
    const double share =
        static_cast<double>(of_chains_.count) / static_cast<double>(samples_of(0).count);
    error = std::hypot(lambda_ * share * std::sqrt(of_chains_.variance), placed);
  }
  for (int h = 0; h < count(); ++h)
    if (has_chains(h))
      scales[h] = error / chain_brightness_ * groups_[h].b / static_cast<double>(groups_[h].steps);
  return scales;
}

}  // namespace mlt
