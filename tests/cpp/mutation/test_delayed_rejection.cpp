// Delayed rejection leaves L* unchanged, and the audit would see it if it did not.
#include "mutation/mutation_testing.h"

namespace mlt::test {
namespace {

MutationPtr perturbation(const std::string& name, const PathTarget& target, double share) {
  return make_mutation(name, target, {{"largest_share", share}});
}

/// The same as another one, but for what a test changes.
class Changed : public Mutation {
 public:
  explicit Changed(MutationPtr whole)
      : Mutation(whole->name(), whole->target()), whole_(std::move(whole)) {}

  double suitability(const PathState& x) const override { return whole_->suitability(x); }
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override {
    return whole_->propose(x, y, context);
  }
  double density(const PathState& x, const PathState& y, const Edit& edit) const override {
    return whole_->density(x, y, edit);
  }
  double relative_density(const PathState& x, const PathState& y, const Edit& edit) const override {
    return whole_->relative_density(x, y, edit);
  }

 private:
  MutationPtr whole_;
};

/// Says q(x -> y) wrongly where a second stage asks for it, but not where its own proposal is
/// judged.
class WrongInSecondStage : public Changed {
 public:
  using Changed::Changed;
  double density(const PathState& x, const PathState& y, const Edit& edit) const override {
    return Changed::density(x, y, edit) * std::exp(5 * x.raster.x);
  }
};

class MoreOnTheRight : public Changed {
 public:
  using Changed::Changed;
  double suitability(const PathState& x) const override {
    return Changed::suitability(x) * std::exp(x.raster.x - 8);
  }
};

AuditReport audit_two_stages(const PathTarget& target, const MutationPtr& first,
                             const std::string& second, uint64_t paths,
                             double significance = 1e-5) {
  AuditSettings how;
  how.paths = paths;
  how.significance = significance;
  const auto weights = std::make_shared<MixtureWeights>(std::vector<double>{1.0});
  // A large second stage: q(y2 -> y1) is to differ from q(x -> y1).
  return audit(target, PathMixture({first}, weights, {perturbation(second, target, 0.3)}), how);
}

struct Case {
  std::string scene, mutation;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.mutation << " on " << c.scene; }

class DelayedRejectionOfPaths : public testing::TestWithParam<Case> {};

TEST_P(DelayedRejectionOfPaths, LeavesTheTargetUnchanged) {
  const ScenePtr scene = make_scene(GetParam().scene).scene;
  const PathTarget target = path_target(scene);
  const std::string& name = GetParam().mutation;
  const AuditReport report = audit_two_stages(target, perturbation(name, target, 0.5), name, 60000);
  EXPECT_EQ(report.verdict, Verdict::nothing_found) << report.text();
}

INSTANTIATE_TEST_SUITE_P(Mutations, DelayedRejectionOfPaths,
                         testing::Values(Case{"cornell", "lens"}, Case{"mirrors", "lens"},
                                         Case{"near_specular", "lens"}, Case{"cornell", "caustic"},
                                         Case{"caustic", "caustic"}, Case{"sun", "caustic"},
                                         Case{"mirrors", "multi_chain"}),
                         [](const auto& info) {
                           return info.param.scene + "_" + info.param.mutation;
                         });

TEST(DelayedRejectionOfPaths, NeedsTheDensityOfTheFirstStage) {
  const ScenePtr scene = make_scene("near_specular").scene;
  const PathTarget target = path_target(scene);
  const auto wrong = std::make_shared<WrongInSecondStage>(perturbation("lens", target, 0.5));
  const AuditReport report = audit_two_stages(target, wrong, "lens", 200000, 1e-4);
  EXPECT_EQ(report.verdict, Verdict::wrong) << report.text();
}

/// The formula of path_mixture.h by plain products, where the choice of the mutation depends on the
/// path.
TEST(DelayedRejectionOfPaths, HasTheQuotientOfPlainProducts) {
  const ScenePtr scene = make_scene("cornell").scene;
  const PathTarget target = path_target(scene);
  const auto first = std::make_shared<MoreOnTheRight>(perturbation("lens", target, 0.5));
  const MutationPtr other = perturbation("lens", target, 0.1), smaller = other;
  const auto weights = std::make_shared<MixtureWeights>(std::vector<double>{1.0, 1.0});
  PathMixture mixture({first, other}, weights, {smaller, nullptr});
  const auto q1 = [&](const PathState& x, const PathState& y) {
    const double share = first->suitability(x);
    return share / (share + other->suitability(x)) * first->density(x, y, mixture.edit());
  };
  const auto rejection = [&](const PathState& x, const PathState& y) {
    return 1 - std::min(1.0, y.brightness() * q1(y, x) / (x.brightness() * q1(x, y)));
  };
  const auto one_way = [&](const PathState& x, const PathState& y1, const PathState& y2) {
    return x.brightness() * q1(x, y1) * rejection(x, y1) * smaller->density(x, y2, mixture.edit());
  };
  int compared = 0;
  Rng rng(4, Purpose::test, 0);
  std::array<PathState, PathMixture::stages> y;
  for_each_light_path(target, 5, 1000, [&](const PathState& x) {
    if (!(x.target > 0)) return;
    mixture.propose(x, y, 0, rng);
    const Transition second = mixture.propose(x, y, 1, rng);
    if (second.forward == impossible.forward || second.backward == 0) return;
    if (!(y[0].target > 0) || rejection(x, y[0]) == 0) return;
    const double expected = one_way(y[1], y[0], x) / one_way(x, y[0], y[1]);
    EXPECT_NEAR(second.backward / second.forward, expected, 1e-6 * expected);
    ++compared;
  });
  EXPECT_GT(compared, 50);
}

TEST(DelayedRejectionOfPaths, FindsMovesWhereTheFirstStageFails) {
  const ScenePtr scene = make_scene("cornell").scene;
  const PathTarget target = path_target(scene);
  const auto first = perturbation("lens", target, 0.5);
  AuditSettings how;
  how.paths = 20000;
  const AuditReport one = audit(target, first, how);
  const AuditReport two = audit_two_stages(target, first, "lens", how.paths);
  const auto rejected = [](const AuditReport& report) { return report.steps - report.accepted; };
  EXPECT_LT(static_cast<double>(rejected(two)), 0.9 * static_cast<double>(rejected(one)));
}

}  // namespace
}  // namespace mlt::test
