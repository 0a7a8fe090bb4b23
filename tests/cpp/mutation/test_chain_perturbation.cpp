// Distances, angles and forms that the perturbations are made of.
#include "mutation/chain_perturbation.h"

#include "harness/chi_square.h"
#include "mutation/mutation_testing.h"

namespace mlt::test {
namespace {

TEST(ExponentialRadius, StaysBetweenItsRadii) {
  const ExponentialRadius radius{0.1, 25};
  EXPECT_DOUBLE_EQ(radius.sample(0), 25);
  EXPECT_NEAR(radius.sample(1), 0.1, 1e-15);
  EXPECT_NEAR(radius.sample(0.5), std::sqrt(0.1 * 25), 1e-12);
  EXPECT_EQ(radius.planar_pdf(0.05), 0);
  EXPECT_EQ(radius.planar_pdf(26), 0);
  EXPECT_DOUBLE_EQ((radius * 2).smallest, 0.2);
  EXPECT_DOUBLE_EQ((radius * 2).largest, 50);
}

TEST(ExponentialRadius, FollowsItsDensityInThePlane) {
  const ExponentialRadius radius{0.3, 2};
  const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
    const double r = radius.sample(rng.next()), phi = 2 * pi * rng.next();
    return Vec2(r * std::cos(phi), r * std::sin(phi));
  };
  const auto result = chi_square_rect(
      sample, [&](const Vec2& p) { return radius.planar_pdf(glm::length(p)); }, Vec2(-2), Vec2(2),
      100000, 1);
  EXPECT_GT(result.p_value, 1e-4) << result;
}

TEST(ExponentialRadius, FollowsItsDensityOnTheSphere) {
  const ExponentialRadius angle{0.2, 1.4};
  const Vec3 axis = normalize(Vec3(0.3, -0.5, 0.6));
  const auto sample = [&](Rng& rng) -> std::optional<Vec3> {
    return ChainPerturbation::perturb(axis, angle, rng);
  };
  const auto pdf = [&](const Vec3& w) {
    return angle.angular_pdf(std::acos(std::clamp(dot(w, axis), -1.0, 1.0)));
  };
  const auto result = chi_square_sphere(sample, pdf, 100000, 2);
  EXPECT_GT(result.p_value, 1e-4) << result;
}

TEST(ChainPerturbation, TurnsALongChainLessThanAShortOne) {
  // A path on the axis of a camera with pixels of 1/100 rad: L at 9, D at 3, E at 0, or with D
  // close to L.
  const ScenePtr scene = make_scene("cornell").scene;
  const PathTarget target = path_target(scene);
  const ChainPerturbation chain(*scene, StepSizes());
  const PathState x = find_path(target, "LDE");
  const ExponentialRadius& pixels = chain.image_radius();
  EXPECT_DOUBLE_EQ(pixels.smallest, StepSizes().smallest_pixels);
  EXPECT_DOUBLE_EQ(pixels.largest, StepSizes().largest_share * std::hypot(16, 12));

  const ExponentialRadius angle = chain.angle(x, 0, 1, 1);
  const double seen = length(x[2].at.p - x[1].at.p), own = length(x[1].at.p - x[0].at.p);
  // A pixel seen from the lens: d(angle)^2 = 1 / (density of the raster in solid angle).
  const double cosine = abs_cos(x[2].at, direction(x[2].at, x[1].at));
  const double pixel = 1 / std::sqrt(chain.raster_per_direction(x) * cosine);
  EXPECT_NEAR(angle.largest, std::min(pixels.largest * pixel * seen / own, pi / 2), 1e-9);
  EXPECT_LE(angle.smallest, angle.largest / 2);
}

TEST(ChainPerturbation, MovesTheImageAboutAsFarAsTheLensPerturbation) {
  // Turning the direction that leaves the lamp by an angle moves the vertex, and so the image
  // position.
  const ScenePtr scene = make_scene("point").scene;
  const PathTarget target = path_target(scene);
  const auto caustic = make_mutation("caustic", target);
  const ChainPerturbation chain(*scene, StepSizes());
  Rng rng(3, Purpose::test, 0);
  MutationScratch scratch;
  PathState y;
  double sum = 0, count = 0;
  for_each_light_path(target, 4, 1000, [&](const PathState& x) {
    if (caustic->suitability(x) == 0) return;
    MutationContext context{rng, scratch};
    if (!caustic->propose(x, y, context) || !(y.target > 0)) return;
    sum += std::log(glm::length(y.raster - x.raster));
    ++count;
  });
  ASSERT_GT(count, 500);
  const ExponentialRadius& pixels = chain.image_radius();
  const double expected = 0.5 * (std::log(pixels.smallest) + std::log(pixels.largest));
  EXPECT_NEAR(sum / count, expected,
              std::log(2));  // Within a factor of two: surfaces are seen at a slant.
}

TEST(ChainPerturbation, FindsTheVertexThatEndsAChain) {
  PathState x;
  x.path.vertices.resize(6);  // L D S D S E
  x.terms.at.resize(6);
  x.terms[2].specular = x.terms[4].specular = true;
  EXPECT_EQ(ChainPerturbation::chain_end(x, 5, -1), 3);
  EXPECT_EQ(ChainPerturbation::chain_end(x, 3, -1), 1);
  EXPECT_EQ(ChainPerturbation::chain_end(x, 1, -1), 0);
  EXPECT_EQ(ChainPerturbation::chain_end(x, 0, 1), 1);
  EXPECT_EQ(ChainPerturbation::chain_end(x, 1, 1), 3);
  EXPECT_EQ(ChainPerturbation::chain_end(x, 3, 1), 5);
}

/// Veach's forms, (L|D)DS*E, (L|D)S*DE and (L|D)(DS+)+DS*E, the light side of the joint not being
/// specular; and those whose chains lead on to a light that can be hit, LS*E and L(S+D)+S*E.
TEST(Mutations, SuitTheirForms) {
  const ScenePtr scene = make_scene("mirrors").scene;
  const PathTarget target = path_target(scene);
  const auto suits = [&](const std::string& mutation, const std::string& signature) {
    const PathState x = find_path(target, signature);
    return make_mutation(mutation, target)->suitability(x) > 0;
  };
  for (const char* form :
       {"LDE", "LDDE", "LDSE", "LDDSE", "LDSSE", "LSDDE", "LDSSSSE", "LE", "LSE"})
    EXPECT_TRUE(suits("lens", form)) << form;
  for (const char* form : {"LSDE", "LSDSE", "LDSDE"}) EXPECT_FALSE(suits("lens", form)) << form;
  for (const char* form : {"LDE", "LDDE", "LSDE", "LSSDE", "LDSDE", "LSDSDE"})
    EXPECT_TRUE(suits("caustic", form)) << form;
  for (const char* form : {"LE", "LSE", "LDSE", "LSDSE"})
    EXPECT_FALSE(suits("caustic", form)) << form;
  for (const char* form : {"LDSDE", "LDSDSE", "LDSSDE", "LSDE", "LSDSE"})
    EXPECT_TRUE(suits("multi_chain", form)) << form;
  for (const char* form : {"LE", "LSE", "LDE", "LDSE", "LDDE", "LSDDE"})
    EXPECT_FALSE(suits("multi_chain", form)) << form;
  for (const char* form : {"LSDE", "LDSDE", "LSDSE", "LSDDE"})
    EXPECT_TRUE(suits("manifold", form)) << form;
  for (const char* form : {"LE", "LSE", "LDE", "LDDE", "LDSE", "LDDSE"})
    EXPECT_FALSE(suits("manifold", form)) << form;
  for (const char* form : {"LDE", "LDSE", "LDDSSE"})
    EXPECT_TRUE(suits("lens_subpath", form)) << form;
  for (const char* form : {"LE", "LSE", "LSDE", "LDSDE"})
    EXPECT_FALSE(suits("lens_subpath", form)) << form;
  for (const char* form : {"LE", "LSE", "LSDSE"}) EXPECT_TRUE(suits("bidirectional", form)) << form;
}

}  // namespace
}  // namespace mlt::test
