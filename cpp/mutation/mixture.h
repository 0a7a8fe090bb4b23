// A mixture of mutations as the kernel of the one Metropolis-Hastings step. Among those that suit the
// current path one is chosen by weight; the probability of that choice is part of T, since the reverse
// path may suit other mutations (Veach 1997, sec. 11.4.1).
#pragma once

#include "markov/step.h"
#include "mutation/mutation.h"

#include <array>
#include <memory>
#include <vector>

namespace mlt {

/// Paths of more edges than this share a row of weights and of statistics.
constexpr int longest_row = 16;

/// Weights of the mutations, for each path length: row k is for paths of k edges, the last row for all
/// longer ones.
class MutationChoice {
 public:
  explicit MutationChoice(std::vector<double> weights) : rows_{std::move(weights)} {}
  explicit MutationChoice(std::vector<std::vector<double>> rows) : rows_(std::move(rows)) {}

  const std::vector<double>& weights(int edges) const {
    return rows_[std::min<size_t>(edges, rows_.size() - 1)];
  }
  size_t rows() const { return rows_.size(); }

 private:
  std::vector<std::vector<double>> rows_;
};

using Mutations = std::vector<std::shared_ptr<const Mutation>>;

class MutationMixture {
 public:
  MutationMixture(const Mutations& mutations, const MutationChoice& choice, RayCounts& rays)
      : mutations_(&mutations), choice_(&choice), rays_(&rays), suitability_(mutations.size()) {}

  /// The raster position that a fresh lens subpath is to use in the next step.
  void set_stratified_raster(const StratifiedRaster& raster) { stratified_raster_ = raster; }

  Transition propose(const PathState& x, std::array<PathState, 1>& proposals, size_t, Rng& rng) {
    PathState& y = proposals[0];
    generated_ = false;
    const std::vector<double>& weights = choice_->weights(x.edges());
    double sum = 0;
    for (size_t i = 0; i < mutations_->size(); ++i) {
      suitability_[i] = weights[i] > 0 ? weights[i] * (*mutations_)[i]->suitability(x) : 0.0;
      sum += suitability_[i];
    }
    suited_ = sum > 0;
    double u = rng.next() * sum;
    chosen_ = 0;
    while (chosen_ + 1 < suitability_.size() && (u -= suitability_[chosen_]) >= 0) ++chosen_;
    if (suitability_[chosen_] == 0) return impossible;
    const Mutation& mutation = *(*mutations_)[chosen_];
    MutationContext context{rng, *rays_, stratified_raster_};
    const std::optional<Edit> edit = mutation.propose(x, y, context);
    if (!edit || y.target == 0) return impossible;
    generated_ = true;
    const double forward = suitability_[chosen_] / sum * mutation.density(x, y, *edit);
    if (forward == 0) return impossible;  // y has another form than the mutation makes
    const double backward = probability(y) * mutation.density(y, x, edit->reversed());
    return {forward / y.target, backward / x.target};
  }

  /// Whether any mutation suited the path of the last step, and which one was chosen.
  bool suited() const { return suited_; }
  size_t chosen() const { return chosen_; }
  bool generated() const { return generated_; }

 private:
  /// P_choose of the chosen mutation at y.
  double probability(const PathState& y) const {
    const std::vector<double>& weights = choice_->weights(y.edges());
    double sum = 0, own = 0;
    for (size_t i = 0; i < mutations_->size(); ++i) {
      const double w = weights[i] > 0 ? weights[i] * (*mutations_)[i]->suitability(y) : 0.0;
      sum += w;
      if (i == chosen_) own = w;
    }
    return own > 0 ? own / sum : 0.0;
  }

  const Mutations* mutations_;
  const MutationChoice* choice_;
  RayCounts* rays_;
  std::vector<double> suitability_;
  StratifiedRaster stratified_raster_;
  size_t chosen_ = 0;
  bool suited_ = false, generated_ = false;
};

}  // namespace mlt
