#include <gmock/gmock.h>

#include "base/atomic_file.h"
#include "base/rng.h"
#include "harness/chi_square.h"
#include "scene/emitter/emitter.h"
#include "scene/emitter/ies_file.h"
#include "scene/emitter/intensity_table.h"
#include "scene/plugin_testing.h"

namespace mlt {

Plugin emitter_ies();
Plugin emitter_point();

namespace {

using test::expect_close;
using test::make;
using testing::ElementsAre;
using testing::HasSubstr;

/// A file with these lines after the one with TILT; they begin with the number of lamps.
std::string ies(const std::string& numbers) {
  return "IESNA:LM-63-2002\r\n[TEST] none\r\n[MANUFAC] TILT\r\nTILT=NONE\r\n" + numbers;
}

/// 2 x 3 candelas, which the factors 2, .5 and 4 multiply by 4.
const char* const quarter = "1 1000 2 2 3 1 2 0 0 0\n.5 4 60\n0 90\n0 30 90\n1 2\n 3 4\n5 6\n";

TEST(IesFile, HasItsCandelasTimesAllFactors) {
  const IesProfile read = parse_ies(ies("1 -1 2 3 1 1 2 0 0 0 .5 4 60\n0 45 90 0\n1 2.5 3e1"), "");
  EXPECT_THAT(read.vertical, ElementsAre(0, 45, 90));
  EXPECT_THAT(read.horizontal, ElementsAre(0, 360));
  EXPECT_THAT(read.candela, ElementsAre(4, 10, 120, 4, 10, 120));
}

TEST(IesFile, IsMirroredToTheWholeCircle) {
  const IesProfile read = parse_ies(ies(quarter), "");
  EXPECT_THAT(read.horizontal, ElementsAre(0, 30, 90, 150, 180, 210, 270, 330, 360));
  std::vector<double> at_nadir;
  for (size_t i = 0; i < read.candela.size(); i += 2) at_nadir.push_back(read.candela[i] / 4);
  EXPECT_THAT(at_nadir, ElementsAre(1, 3, 5, 3, 1, 3, 5, 3, 1));
  const IesProfile half =
      parse_ies(ies("1 1 1 2 3 1 1 0 0 0 1 1 1 90 180 0 60 180 1 2 3 4 5 6"), "");
  EXPECT_THAT(half.horizontal, ElementsAre(0, 60, 180, 300, 360));
  EXPECT_THAT(half.candela, ElementsAre(1, 2, 3, 4, 5, 6, 3, 4, 1, 2));
}

std::string problem(const std::string& bytes) {
  try {
    parse_ies(bytes, "lamp.ies");
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(IesFile, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(problem("#VRML"), HasSubstr("has no line TILT=NONE"));
  EXPECT_THAT(problem("TILT=INCLUDE\n"), HasSubstr("lamp.ies:1: 'TILT=INCLUDE' is not supported"));
  EXPECT_THAT(problem(ies("1 1 1 2 x")), HasSubstr("lamp.ies:5: 'x' is not the number of hor"));
  EXPECT_THAT(problem(ies("1 1 1 2.5")), HasSubstr("an integer from 1 to 10000"));
  EXPECT_THAT(problem(ies("1 1 1 2 1 2")), HasSubstr("only 1 is supported, which is type C"));
  const std::string head = "1 1 1 2 1 1 1 0 0 0 1 1 1\n";
  EXPECT_THAT(problem(ies(head + "0 80")),
              HasSubstr("lamp.ies:6: vertical angles run from 0 to 80"));
  EXPECT_THAT(problem(ies(head + "90 0")), HasSubstr("angles should ascend"));
  EXPECT_THAT(problem(ies(head + "0 90\n5")),
              HasSubstr("lamp.ies:7: horizontal angles run from 5"));
  EXPECT_THAT(problem(ies(head + "0 90\n0\n1 -2")), HasSubstr("a candela value is -2, but"));
  EXPECT_THAT(problem(ies(head + "0 90\n0\n1")), HasSubstr("a candela value is missing"));
  EXPECT_THAT(problem(ies("1 1 0")), HasSubstr("the multiplier of the candelas is 0"));
}

IntensityTable varied() {
  return {{0, 0.3, 1, 2, pi}, {0, 1, 4, 2 * pi}, {1, 2, 0, 0, 5, 1, 3, 0, 0, 4,
                                                  2, 0, 0, 0, 3, 1, 2, 0, 0, 5}};
}

TEST(IntensityTable, IsBilinearInBothAngles) {
  const IntensityTable table = varied();
  const auto at = [&](double theta, double phi) {
    return table.at(
        {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
  };
  EXPECT_NEAR(at(0.3, 1), 3, 1e-12);
  EXPECT_NEAR(at(0.3, 2.5), 1.5, 1e-12);
  EXPECT_NEAR(at(0.15, 1), 2, 1e-12);
  EXPECT_NEAR(at(0.15, 2.5), 1.5, 1e-12);
  EXPECT_NEAR(at(1.5, 5), 0, 1e-12);
}

TEST(IntensityTable, SamplesHaveItsDensity) {
  const IntensityTable table = varied();
  const auto result = test::chi_square_sphere(
      [&](Rng& rng) -> std::optional<Vec3> { return table.sample({rng.next(), rng.next()}); },
      [&](const Vec3& w) { return table.pdf(w); }, 50'000, 1);
  EXPECT_GT(result.p_value, 1e-4) << result;
  EXPECT_NEAR(result.integral, 1, 1e-4);
}

TEST(IntensityTable, KnowsItsIntegral) {
  const IntensityTable table = varied();
  double sum = 0;
  constexpr int n = 1000;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double theta = pi * (i + 0.5) / n, phi = 2 * pi * (j + 0.5) / n;
      const double r = std::sin(theta);
      sum += table.at({r * std::cos(phi), r * std::sin(phi), std::cos(theta)}) * r;
    }
  EXPECT_NEAR(sum * 2 * pi * pi / (n * n), table.integral(), 1e-4);
}

std::shared_ptr<Emitter> luminaire(const std::string& bytes, test::Given given = {}) {
  const std::string path = testing::TempDir() + "mlt_lamp.ies";
  write_file(path, bytes);
  given["filename"] = path;
  return make<Emitter>(emitter_ies(), given);
}

TEST(Luminaire, OfOneValueIsAPointLight) {
  const auto lamp = luminaire(ies("1 1 683 2 1 1 1 0 0 0 1 1 1 0 180 0 2 2"));
  const auto point = make<Emitter>(emitter_point(), {{"intensity", 2.0}});
  const SurfacePoint x0 = lamp->sample_position(Vec2(0.5), 0).at;
  Rng rng(1, Purpose::test, 0);
  for (int i = 0; i < 100; ++i) {
    const Vec3 w = lamp->sample_ray(x0, {rng.next(), rng.next()}).direction;
    EXPECT_NEAR(lamp->eval(x0, w)[0], point->eval(x0, w)[0], 1e-12);
    EXPECT_NEAR(lamp->pdf_ray(x0, w), point->pdf_ray(x0, w), 1e-12);
  }
  expect_close(lamp->power(), point->power(), 1e-12);
}

TEST(Luminaire, HangsDownAndTurnsFromXTowardsY) {
  const auto lamp = luminaire(ies("1 1 683 2 5 1 1 0 0 0 1 1 1 0 90 0 90 180 270 360\n"
                                  "1 2 1 3 1 4 1 5 1 2"),
                              {{"scale", Triple{1, 2, 3}}});
  const SurfacePoint x0 = lamp->sample_position(Vec2(0.5), 0).at;
  const auto red = [&](const Vec3& w) { return lamp->eval(x0, w)[0]; };
  EXPECT_NEAR(red({0, 0, -1}), 1, 1e-12);
  EXPECT_NEAR(red({1, 0, 0}), 2, 1e-12);
  EXPECT_NEAR(red({0, 1, 0}), 3, 1e-12);
  EXPECT_NEAR(red({-1, 0, 0}), 4, 1e-12);
  EXPECT_NEAR(red({0, -1, 0}), 5, 1e-12);
  EXPECT_EQ(red({0, 0, 1}), 0);
  expect_close(lamp->eval(x0, {0, 0, -1}).rgb(), {1, 2, 3}, 1e-12);
}

TEST(Luminaire, RefusesDarkness) {
  const auto dark = [] { luminaire(ies("1 1 1 2 1 1 1 0 0 0 1 1 1 0 90 0 0 0")); };
  EXPECT_THROW(dark(), SceneError);
}

}  // namespace
}  // namespace mlt
