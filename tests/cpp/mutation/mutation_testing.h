// What the tests of mutations share: settings, paths to start from, mutations spoilt on purpose.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "mutation/audit.h"
#include "mutation/mutation_registry.h"
#include "mutation/path_seeds.h"
#include "scenes.h"

namespace mlt::test {

inline PathTarget path_target(const ScenePtr& scene, int max_depth = 8) {
  PathRules rules;
  rules.max_depth = max_depth;
  return PathTarget(scene, rules);
}

/// With steps of primary samples and moves in media that are large: small ones change too little
/// for a fault to be seen.
inline MutationPtr make_large_mutation(const MutationPlugin& plugin, const PathTarget& target,
                                       MutationValues values = {}) {
  if (plugin.schema.find("step_size")) values.push_back({"step_size", 0.4});
  if (plugin.schema.find("smallest_move")) values.push_back({"smallest_move", 0.2});
  return make_mutation(plugin.name(), target, values);
}

inline Mutations all_mutations(const PathTarget& target) {
  Mutations all;
  for (const MutationPlugin& plugin : mutation_plugins())
    all.push_back(make_large_mutation(plugin, target));
  return all;
}

inline MixtureWeights default_weights() {
  std::vector<double> weights;
  for (const MutationPlugin& plugin : mutation_plugins()) weights.push_back(plugin.weight);
  return MixtureWeights(weights);
}

/// Calls found(x) for the paths of `samples` bidirectional samples.
inline void for_each_light_path(const PathTarget& target, uint64_t seed, int samples,
                                const std::function<void(const PathState&)>& found) {
  PathSeeds seeds(target);
  PathState x;
  for (int i = 0; i < samples; ++i) {
    Rng rng(seed, Purpose::test, static_cast<uint64_t>(i));
    seeds.draw_all(RandomSampler(rng), [&](const Connection& connection) {
      seeds.assemble(connection, x);
      found(x);
    });
  }
}

/// Calls found(i, x, y, edit) for the proposals y with light that mutation i makes of such paths x.
template <class Found>
void for_each_proposal(const PathTarget& target, const Mutations& all, uint64_t seed, int samples,
                       Found&& found) {
  Rng rng(1, Purpose::test, 0);
  MutationScratch scratch;
  PathState y;
  for_each_light_path(target, seed, samples, [&](const PathState& x) {
    if (!(x.target > 0)) return;
    for (size_t i = 0; i < all.size(); ++i) {
      if (all[i]->suitability(x) == 0) continue;
      MutationContext context{rng, scratch};
      const auto edit = all[i]->propose(x, y, context);
      if (edit && y.target > 0) found(i, x, y, *edit);
    }
  });
}

/// The first path of this signature that `suits`.
inline PathState find_path(const PathTarget& target, const std::string& wanted,
                           const std::function<bool(const PathState&)>& suits = nullptr) {
  PathState result;
  for (uint64_t seed = 1; result.path.vertices.empty() && seed < 200; ++seed)
    for_each_light_path(target, seed, 200, [&](const PathState& x) {
      if (result.path.vertices.empty() && signature(x.terms) == wanted && (!suits || suits(x)))
        result = x;
    });
  EXPECT_FALSE(result.path.vertices.empty()) << "no path " << wanted;
  return result;
}

/// A mutation whose density lacks a factor.
class BrokenTwin : public Mutation {
 public:
  using Factor = std::function<double(const PathState& x, const PathState& y, const Edit& edit)>;

  BrokenTwin(MutationPtr whole, Factor dropped)
      : Mutation(whole->name(), whole->target()),
        whole_(std::move(whole)),
        dropped_(std::move(dropped)) {}

  double suitability(const PathState& x) const override { return whole_->suitability(x); }
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    return whole_->propose(x, y, context);
  }
  double density(const PathState& x, const PathState& y, const Edit& edit) const override {
    const double whole = whole_->density(x, y, edit);
    return whole == 0 ? 0 : whole / dropped_(x, y, edit);
  }

 private:
  MutationPtr whole_;
  Factor dropped_;
};

}  // namespace mlt::test
