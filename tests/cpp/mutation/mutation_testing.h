// What the tests of mutations share: settings, paths to start from, mutations spoilt on purpose.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "mutation/audit.h"
#include "mutation/mutation_registry.h"
#include "mutation/mutation_scenes.h"
#include "path/bidirectional_sampler.h"
#include "path/samplers.h"

namespace mlt::test {

inline MutationSettings mutation_settings(int max_depth = 8) {
  MutationSettings settings;
  settings.max_depth = max_depth;
  return settings;
}

inline Mutations all_mutations(const Scene& scene, const MutationSettings& settings) {
  Mutations all;
  for (const MutationKind& kind : mutation_kinds())
    all.push_back(make_mutation(kind.name, scene, settings));
  return all;
}

inline MutationChoice default_choice() {
  std::vector<double> weights;
  for (const MutationKind& kind : mutation_kinds()) weights.push_back(kind.weight);
  return MutationChoice(weights);
}

inline std::string signature_of(const PathState& x) {
  return signature(x.terms);
}

/// Calls found(x) for the paths of `samples` bidirectional samples.
inline void for_each_light_path(const Scene& scene, const MutationSettings& settings, uint64_t seed,
                                int samples, const std::function<void(const PathState&)>& found) {
  BidirectionalSettings how;
  how.rules.max_depth = settings.max_depth;
  BidirectionalSampler paths(scene, how);
  RayCounts rays;
  PathState x;
  for (int i = 0; i < samples; ++i) {
    Rng rng(seed, Purpose::test, static_cast<uint64_t>(i));
    RandomSampler sampler(rng);
    paths.sample(scene.camera().raster().sample(sampler.next2()), sampler, rays);
    paths.connect_all(rays, [&](const Connection& connection) {
      paths.assemble(connection, x.path);
      evaluate(scene, settings, x);
      found(x);
    });
  }
}

/// Calls found(i, x, y, edit) for the proposals y with light that mutation i makes of such paths x.
template <class Found>
void for_each_proposal(const Scene& scene, const MutationSettings& settings, const Mutations& all,
                       uint64_t seed, int samples, Found&& found) {
  Rng rng(1, Purpose::test, 0);
  RayCounts rays;
  PathState y;
  for_each_light_path(scene, settings, seed, samples, [&](const PathState& x) {
    if (!(x.target > 0)) return;
    for (size_t i = 0; i < all.size(); ++i) {
      if (all[i]->suitability(x) == 0) continue;
      MutationContext context{rng, rays, unstratified(scene.camera().raster(), rng)};
      const auto edit = all[i]->propose(x, y, context);
      if (edit && y.target > 0) found(i, x, y, *edit);
    }
  });
}

/// The first path of this signature that `suits`.
inline PathState find_path(const Scene& scene, const MutationSettings& settings,
                           const std::string& signature,
                           const std::function<bool(const PathState&)>& suits = nullptr) {
  PathState result;
  for (uint64_t seed = 1; result.path.vertices.empty() && seed < 200; ++seed)
    for_each_light_path(scene, settings, seed, 200, [&](const PathState& x) {
      if (result.path.vertices.empty() && signature_of(x) == signature && (!suits || suits(x)))
        result = x;
    });
  EXPECT_FALSE(result.path.vertices.empty()) << "no path " << signature;
  return result;
}

/// A mutation whose density lacks a factor.
class BrokenTwin : public Mutation {
 public:
  using Factor = std::function<double(const PathState& x, const PathState& y, const Edit& edit)>;

  BrokenTwin(std::shared_ptr<const Mutation> whole, Factor dropped)
      : whole_(std::move(whole)), dropped_(std::move(dropped)) {}

  const std::string& name() const override { return whole_->name(); }
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
  std::shared_ptr<const Mutation> whole_;
  Factor dropped_;
};

}  // namespace mlt::test
