// What a mutation's edit touched, computed anew, and all of the path computed afresh are the same
// bits.
#include <cstring>
#include <set>

#include "mutation/mutation_testing.h"

namespace mlt::test {
namespace {

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_bits(const Vec2& a, const Vec2& b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y); }
bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}
bool same_bits(const Spectrum& a, const Spectrum& b) { return std::memcmp(&a, &b, sizeof a) == 0; }
std::string difference(const TermsAt& a, const TermsAt& b, bool has_edge) {
  if (has_edge && !same_bits(a.G, b.G)) return "G";
  if (!same_bits(a.from_light, b.from_light)) return "from_light";
  if (!same_bits(a.from_camera, b.from_camera)) return "from_camera";
  if (a.connectable != b.connectable) return "connectable";
  if (a.specular != b.specular) return "specular";
  const VertexTerms &s = a.vertex, &t = b.vertex;
  if (!same_bits(s.f, t.f) || !same_bits(s.pdf_from_light, t.pdf_from_light) ||
      !same_bits(s.pdf_from_camera, t.pdf_from_camera))
    return "terms";
  return "";
}

std::string difference(const PathState& a, const PathState& b) {
  if (a.path.vertices.size() != b.path.vertices.size()) return "length";
  if (!same_bits(a.target, b.target)) return "target";
  if (!same_bits(a.rgb, b.rgb)) return "rgb";
  if (a.target > 0 && !same_bits(a.raster, b.raster)) return "raster";
  const PathTerms &s = a.terms, &t = b.terms;
  if (!same_bits(s.direct, t.direct)) return "direct";
  if (s.light_can_be_hit != t.light_can_be_hit || s.camera_can_be_hit != t.camera_can_be_hit)
    return "can be hit";
  for (int i = 0; i <= s.edges(); ++i) {
    const std::string what = difference(s[i], t[i], i < s.edges());
    if (!what.empty()) return what + " of vertex " + std::to_string(i);
  }
  return "";
}

class LightPaths : public testing::TestWithParam<std::string> {};

TEST_P(LightPaths, AreTheSameBitsWhenAnEditIsComputedAndWhenAllIs) {
  const ScenePtr scene = make_scene(GetParam()).scene;
  const PathTarget target = path_target(scene);
  const Mutations all = all_mutations(target);
  std::vector<int> compared(all.size(), 0);
  const auto compare = [&](size_t i, const PathState& x, const PathState& y, const Edit&) {
    PathState fresh;
    fresh.path = y.path;
    target.evaluate(fresh);
    ASSERT_EQ(difference(y, fresh), "")
        << all[i]->name() << " on " << signature(x.terms) << " to " << signature(y.terms);
    ++compared[i];
  };
  for_each_proposal(target, all, 2, 2000, compare);
  std::set<std::string> of_few_paths = {"multi_chain", "multiplexed", "manifold", "translucent"};
  for (const MutationPlugin& plugin : mutation_plugins())
    if (plugin.supports && !plugin.supports(target.scene())) of_few_paths.insert(plugin.name());
  for (size_t i = 0; i < all.size(); ++i)
    EXPECT_GT(compared[i], of_few_paths.count(all[i]->name()) ? -1 : 50) << all[i]->name();
}

INSTANTIATE_TEST_SUITE_P(Scenes, LightPaths,
                         testing::Values("mirrors", "near_specular", "mixed_lights", "thin_lens",
                                         "light_under_water", "smooth_normals", "windows", "fog",
                                         "prism"),
                         [](const auto& info) { return info.param; });

TEST(LightPaths, KeepTheChoiceOfTheMutationsThatSuitThem) {
  const PathTarget target = path_target(make_scene("mirrors").scene);
  const Mutations all = all_mutations(target);
  const std::vector<double> weights = default_weights()[0];
  PathChain chain(path_mixture(all, weights), Rng(5, Purpose::test, 0), find_path(target, "LDDE"));
  int moved = 0;
  for (int step = 0; step < 5000; ++step) {
    moved += chain.step([](const PathState&, double) {}).accepted >= 0;
    const PathState& x = chain.state();
    const bool suits = chain.kernel().suits(x);
    EXPECT_EQ(suits, x.choice.sum > 0);
    for (size_t i = 0; i < all.size(); ++i)
      ASSERT_EQ(x.choice.shares[i], weights[i] * all[i]->suitability(x)) << all[i]->name();
  }
  EXPECT_GT(moved, 500);
}

TEST(LightPaths, ReverseAnEdit) {
  const Edit edit{2, 4, 1};
  EXPECT_EQ(edit.deleted(), 3);
  EXPECT_EQ(edit.shift(), -2);
  const Edit back = edit.reversed();
  EXPECT_EQ(back.first, 2);
  EXPECT_EQ(back.last, 2);
  EXPECT_EQ(back.inserted, 3);
  const Edit nothing_deleted{3, 2, 2};
  EXPECT_EQ(nothing_deleted.deleted(), 0);
  EXPECT_EQ(nothing_deleted.reversed().inserted, 0);
}

TEST(LightPaths, SpliceKeepsWhatLiesOutsideOfTheEdit) {
  const ScenePtr scene = make_scene("cornell").scene;
  const PathTarget target = path_target(scene);
  const PathState x = find_path(target, "LDDDE");
  for (const Edit edit :
       {Edit{1, 2, 1}, Edit{2, 1, 3}, Edit{0, 1, 1}, Edit{3, 4, 2}, Edit{0, 4, 3}}) {
    PathState y;
    splice(x, edit, y);
    ASSERT_EQ(y.edges(), x.edges() + edit.shift());
    for (int i = 0; i <= x.edges(); ++i) {
      if (i >= edit.first && i <= edit.last) continue;
      const int j = i < edit.first ? i : i + edit.shift();
      EXPECT_TRUE(same_bits(x[i].at.p, y[j].at.p)) << i;
      EXPECT_EQ(x[i].kind, y[j].kind) << i;
    }
  }
}

}  // namespace
}  // namespace mlt::test
