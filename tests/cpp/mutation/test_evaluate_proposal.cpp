// Paths that others have made: the edit is found, and light that could not take a path is not
// counted.
#include "mutation/evaluate_proposal.h"
#include "mutation/mutation_testing.h"

namespace mlt::test {
namespace {

TEST(Difference, IsTheSmallestEdit) {
  const ScenePtr scene = make_scene("cornell").scene;
  const PathTarget target = path_target(scene);
  const PathState x = find_path(target, "LDDE");
  const PathState other =
      find_path(target, "LDDDE", [&](const PathState& y) { return y[1].at.p != x[1].at.p; });
  const auto edit = [](const Edit& e) { return std::vector<int>{e.first, e.last, e.inserted}; };
  EXPECT_EQ(edit(difference(x.path, x.path)), (std::vector<int>{4, 3, 0}));
  Path y = x.path;
  y[1] = other[2];
  EXPECT_EQ(edit(difference(x.path, y)), (std::vector<int>{1, 1, 1}));
  EXPECT_EQ(edit(difference(y, x.path)), (std::vector<int>{1, 1, 1}));
  y.vertices.insert(y.vertices.begin() + 2, other[1]);
  EXPECT_EQ(edit(difference(x.path, y)), (std::vector<int>{1, 1, 2}));
  EXPECT_EQ(edit(difference(y, x.path)), (std::vector<int>{1, 2, 1}));
  y = x.path;
  y.vertices.insert(y.vertices.begin() + 2, x[2]);  // doubled
  EXPECT_EQ(edit(difference(x.path, y)), (std::vector<int>{3, 2, 1}));
}

class Adopt : public testing::TestWithParam<std::string> {};

/// What the mutations know about their proposals is found from the vertices alone.
TEST_P(Adopt, ValuesProposalsAsTheirMutationsDo) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  const PathTarget target = path_target(scene);
  const Mutations all = all_mutations(target);
  RayCounts rays;
  int compared = 0, differ = 0;
  const auto compare = [&](size_t, const PathState& x, const PathState& y, const Edit& edit) {
    PathState evaluated;
    evaluated.path = y.path;
    const Edit found = evaluate_proposal(target, x, evaluated, rays);
    if (found.deleted() + found.inserted > 0) {  // the one point of a light may be drawn again
      EXPECT_GE(found.first, edit.first);
      EXPECT_LE(found.last, edit.last);
    }
    EXPECT_EQ(found.shift(), edit.shift());
    ++compared;
    if (evaluated.target != y.target) ++differ;
  };
  for_each_proposal(target, all, 2, 1000, compare);
  // Rays that graze a surface may be seen in one direction and not in the other.
  EXPECT_GT(compared, 200);
  EXPECT_LE(differ, compared / 1000) << "of " << compared;
}

std::string as_name(const testing::TestParamInfo<std::string>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(Scenes, Adopt, testing::ValuesIn(mutation_scene_names()), as_name);

TEST(Passable, IsNoPathThroughAWall) {
  const ScenePtr scene = make_scene("cornell").scene;
  const PathState x = find_path(path_target(scene), "LDDE");
  RayCounts rays;
  EXPECT_TRUE(passable(*scene, x.path, 0, x.edges(), rays));
  Path y = x.path;
  y[1].at.p -= (dot(y[1].at.ng, y[2].at.p - y[1].at.p) > 0 ? 3.0 : -3.0) * y[1].at.ng;
  EXPECT_FALSE(passable(*scene, y, 1, 1, rays));
}

TEST(Passable, IsNoPathThatBendsAMirrorsLaw) {
  const ScenePtr scene = make_scene("mirrors").scene;
  const PathTarget target = path_target(scene);
  RayCounts rays;
  for (const char* signature : {"LDSE", "LSDE"}) {
    const PathState x = find_path(target, signature);
    const int diffuse = signature[1] == 'D' ? 1 : 2;
    EXPECT_TRUE(passable(*scene, x.path, 0, x.edges(), rays));
    Path y = x.path;
    y[diffuse].at.p += 0.05 * y[diffuse].at.shading.s;
    EXPECT_FALSE(passable(*scene, y, diffuse, diffuse, rays)) << signature;
    PathState evaluated;
    evaluated.path = y;
    evaluate_proposal(target, x, evaluated, rays);
    EXPECT_EQ(evaluated.target, 0);
  }
}

}  // namespace
}  // namespace mlt::test
