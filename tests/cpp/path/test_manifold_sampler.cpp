// Manifold sampling as a technique of bidirectional path tracing: its densities and weights, and
// the light that it finds.
#include <gtest/gtest.h>

#include "path_testing.h"
#include "scene_pieces.h"

namespace mlt {
namespace {

using namespace test;

constexpr int max_depth = 7;

std::shared_ptr<const ManifoldGuide> guide_to(const Scene& scene, bool photons) {
  auto guide = std::make_shared<ManifoldGuide>(scene);
  if (photons) guide->follow(send_photons(scene));
  return guide;
}

/// On a scene, without and with photons.
class ManifoldsOf : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  void SetUp() override { scene_ = make_scene(std::get<0>(GetParam())).scene; }
  BidirectionalSettings with_manifolds() const {
    BidirectionalSettings settings = without_roulette(max_depth);
    settings.manifolds = guide_to(*scene_, std::get<1>(GetParam()));
    return settings;
  }

  ScenePtr scene_;
};

/// The sampler caches sums along its walks; the terms of the whole path have the same weights.
TEST_P(ManifoldsOf, WeighPathsByTheirTerms) {
  BidirectionalSettings settings = with_manifolds();
  const ManifoldSampler manifolds(*scene_, settings.manifolds);
  for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
    settings.heuristic = heuristic;
    Worst worst;
    int joined = 0, others = 0;
    for_each_path(*scene_, settings, 1, 2000, [&](const Connection& c, const Path& path) {
      PathTerms terms;
      const auto weight_of = [&](const Path& x) {
        compute_terms(*scene_, x, {settings.sample_direct}, terms);
        const ExtraTechnique extra = manifolds.technique(x, terms);
        return std::vector<double>{weights_by_terms(c, terms, extra, heuristic).chosen};
      };
      worst.add(excess(*scene_, path, weight_of, {c.weight}), technique_name(*scene_, c, path));
      compute_terms(*scene_, path, {settings.sample_direct}, terms);
      const ExtraTechnique technique = manifolds.technique(path, terms);
      joined += c.searches > 0;
      others += c.searches == 0 && technique.count > 0;
      if (c.searches > 0) {
        ASSERT_EQ(technique.s, c.s);
        ASSERT_TRUE(raster_position(*scene_, path));
        ASSERT_LT(glm::length(*raster_position(*scene_, path) - c.raster), 1e-3);
      }
    });
    EXPECT_LT(worst.value, 1) << worst.where;
    EXPECT_GT(joined, 20);
    EXPECT_GT(others, 0);
  }
}

/// Light by a path that a walk from the light could have made, whichever technique has found it.
/// The mean of it over the samples of the technique alone, and of all others together.
TEST_P(ManifoldsOf, FindTheLightThatOtherTechniquesFind) {
  const BidirectionalSettings plain = without_roulette(max_depth);
  const BidirectionalSettings settings = with_manifolds();
  const ManifoldSampler manifolds(*scene_, settings.manifolds);
  BidirectionalSampler with(*scene_, settings), without(*scene_, plain);
  // Chains that photons miss are found rarely, and then count much. After 3,000,000 samples of
  // smooth_glass the means are 0.0152 +- 0.0009 by chains and 0.01554 by the others.
  const int samples = GetParam() == std::tuple("smooth_glass", true) ? 300000 : 20000;
  constexpr double most =
      20;  // of the light of a sample, alike for both: damped, as a function of x
  double mean[2] = {0, 0}, square[2] = {0, 0};
  Path path;
  PathTerms terms;
  RayCounts rays;
  /// T / (1 + T / most) for the quotient T of the path's light and the density of all techniques.
  const auto damped = [&](const Connection& c, bool manifold) {
    manifold ? with.assemble(c, path) : without.assemble(c, path);
    compute_terms(*scene_, path, {true}, terms);
    const ExtraTechnique technique = manifolds.technique(path, terms);
    if (!(technique.count > 0)) return 0.0;
    const double share = weights_by_terms(c, terms, technique, Heuristic::balance).balance;
    if (!(share > 0)) return 0.0;
    const double over_density = luminance(c.contribution) / c.found_again * share;
    const double factor = 1 / (1 + over_density / most);
    return luminance(c.contribution) * factor * (manifold ? 1 : c.weight);
  };
  for (int i = 0; i < samples; ++i) {
    for (const bool manifold : {false, true}) {
      Rng rng(2 + manifold, Purpose::test, static_cast<uint64_t>(i));
      RandomSampler sampler(rng);
      BidirectionalSampler& paths = manifold ? with : without;
      double sum = 0;
      const auto add = [&](const Connection& c) { sum += damped(c, manifold); };
      paths.sample(scene_->camera().raster().sample(sampler.next2()), sampler, rays);
      if (manifold)
        paths.connect_by_manifolds(rays, add);
      else
        paths.connect_all(rays, add);
      mean[manifold] += sum / samples;
      square[manifold] += sum * sum / samples;
    }
  }
  double variance = 0;
  for (int k = 0; k < 2; ++k) variance += (square[k] - sqr(mean[k])) / samples;
  EXPECT_GT(mean[0], 0);
  EXPECT_LT(std::abs(mean[1] - mean[0]), 4 * std::sqrt(variance))
      << mean[0] << " by the others, " << mean[1] << " by chains, +- " << std::sqrt(variance);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ManifoldsOf,
                         testing::Combine(testing::Values("caustic", "smooth_glass",
                                                          "light_under_water", "window_caustic",
                                                          "spinning_instance", "glass_torus"),
                                          testing::Bool()),
                         [](const auto& info) {
                           return std::get<0>(info.param) +
                                  (std::get<1>(info.param) ? "_photons" : "");
                         });

/// How many of these searches, from the lights to what the camera sees, find a chain.
int count_found(const Scene& scene, bool photons, int searches) {
  BidirectionalSettings settings = without_roulette(max_depth);
  BidirectionalSampler walks(scene, settings);
  ManifoldSampler manifolds(scene, guide_to(scene, photons));
  RayCounts rays;
  int found = 0;
  for (int i = 0; i < searches; ++i) {
    Rng rng(4, Purpose::test, static_cast<uint64_t>(i));
    RandomSampler sampler(rng);
    walks.sample(scene.camera().raster().sample(sampler.next2()), sampler, rays);
    if (walks.camera().size() < 2 || walks.light().size() == 0) continue;
    const Vertex &x0 = walks.light()[0].vertex, &y = walks.camera()[1].vertex;
    if (!scene.bsdf(y.at).has_smooth()) continue;
    found += manifolds.find(x0, y, walks.time(), rng, rays);
  }
  return found;
}

TEST(ManifoldPhotons, LeadToChains) {
  const ScenePtr scene = make_scene("glass_torus").scene;
  const int blind = count_found(*scene, false, 5000), led = count_found(*scene, true, 5000);
  EXPECT_GT(blind, 100);
  EXPECT_GT(led, 2 * blind);
}

TEST(ManifoldPhotons, AreBoundedAndNearInTheirCells) {
  ManifoldPhotons photons;
  const Vertex x0;
  Rng rng(5, Purpose::test, 0);
  for (size_t i = 0; i < ManifoldPhotons::most + 100; ++i) {
    const double x = rng.next(), y = rng.next();
    photons.add(x0, VertexKind::inner, {Vec3(x, y, 0), Vec3(x, y, 1), x < 0.5 ? 5u : 4u});
  }
  EXPECT_EQ(photons.size(), ManifoldPhotons::most);
  photons.divide();
  for (int i = 0; i < 1000; ++i) {
    Vertex y;
    y.at.p = {rng.next(), 0.1 + 0.8 * rng.next(), 0};
    const ManifoldPhotons::Cell cell = photons.near(x0, y);
    ASSERT_GE(cell.count, 7);
    ASSERT_LE(cell.count, 16);
    // a cell has the area of its photons, some 16 / 2^16, and may be four times as long as wide
    for (uint64_t k = 0; k < cell.count; ++k)
      ASSERT_LT(length(cell.first[k].at - y.at.p), 4 * std::sqrt(16.0 / ManifoldPhotons::most));
    if (std::abs(y.at.p.x - 0.5) > 0.1) {
      EXPECT_EQ(cell.share(5), y.at.p.x < 0.5 ? 1 : 0);
      EXPECT_EQ(cell.share(4), y.at.p.x < 0.5 ? 0 : 1);
    }
    Vertex lens = y;
    lens.kind = VertexKind::camera;
    EXPECT_EQ(photons.near(x0, lens).count, 0);
  }
}

TEST(ManifoldPhotons, AreTheSameEachTime) {
  const ScenePtr scene = make_scene("caustic").scene;
  const auto a = send_photons(*scene), b = send_photons(*scene);
  EXPECT_GT(a->size(), 1000);
  EXPECT_EQ(a->size(), b->size());
}

TEST(ManifoldPhotons, AreFewIfTheirRaysAre) {
  const auto few = send_photons(*make_scene("caustic").scene, 1 << 10);
  EXPECT_GT(few->size(), 10);
  EXPECT_LT(few->size(), 1 << 10);
}

/// Most light is that of the wire, which a few pixels see, and little comes from what it lights.
TEST(ManifoldSampler, IsUsedWhereAWireInGlassOutshinesWhatItLights) {
  const ScenePtr scene = load_scene(
      camera("0.3, 0.7, 1.3", "0, 0.4, 0", 45, film(64, 36)) +
      rectangle(scale(4) + rotate("x", -90), diffuse("0.05 0.05 0.05")) +
      rectangle(scale(4) + translate(0, 0, -1.2), diffuse("0.05 0.05 0.05")) +
      sphere(0, 0.4, 0, 0.3, glass) +
      sphere(0, 0.4, 0, 0.285, "<boolean name='flip_normals' value='true'/>" + glass) +
      "<shape type='cylinder'><point name='p0' x='-0.1' y='0.4' z='0'/>"
      "<point name='p1' x='0.1' y='0.43' z='0.02'/><float name='radius' value='0.002'/>" +
      area_light("900 600 300") + "</shape>");
  EXPECT_TRUE(learn_manifolds(*scene, {}));
}

/// A block of glass takes little of the image, but what is inside is black without the search.
TEST(ManifoldSampler, IsUsedWhereNothingElseFindsTheLight) {
  const ScenePtr scene =
      load_scene(camera("0.5, 1.6, 3.6", "0, 0.2, 0", 50, film(64, 36)) +
                 rectangle(scale(8) + rotate("x", -90), white) +
                 cube(scale(0.2) + rotate("y", 25) + translate(0, 0.201, 0), glass) +
                 sphere(0, 0.2, 0, 0.1, white) +
                 "<emitter type='directional'><vector name='direction' x='0.4' y='-1' z='-0.3'/>"
                 "<rgb name='irradiance' value='3'/></emitter>");
  EXPECT_TRUE(learn_manifolds(*scene, {}));
}

TEST(ManifoldSampler, IsNotUsedWhereNothingIsSpecular) {
  EXPECT_FALSE(learn_manifolds(*make_scene("cornell").scene, {}));
}

}  // namespace
}  // namespace mlt
