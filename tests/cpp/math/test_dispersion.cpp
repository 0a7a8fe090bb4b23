// Dispersion formulas in closed form, and what factories refuse.
#include "math/dispersion.h"

#include "base/error.h"
#include "math/colorimetry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mlt::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

double abbe_number(const RefractiveIndex& n) {
  return (n.at(line_d) - 1) / (n.at(line_f) - n.at(line_c));
}

TEST(Dispersion, ConstantIsTheSameEverywhere) {
  const RefractiveIndex n = RefractiveIndex::constant(1.5046);
  for (const double nm : {360.0, 589.3, 830.0}) EXPECT_EQ(n.at(nm), 1.5046);
  EXPECT_EQ(n.sodium(), 1.5046);
  EXPECT_FALSE(n.disperses());
}

TEST(Dispersion, CauchyInClosedForm) {
  const RefractiveIndex n = RefractiveIndex::cauchy(1.5, 4000);
  EXPECT_DOUBLE_EQ(n.at(500), 1.516);
  EXPECT_DOUBLE_EQ(n.at(800), 1.50625);
  EXPECT_DOUBLE_EQ(n.sodium(), 1.5 + 4000 / (589.3 * 589.3));
  EXPECT_TRUE(n.disperses());
}

TEST(Dispersion, SellmeierInClosedForm) {
  const RefractiveIndex one = RefractiveIndex::sellmeier({{1, .01}});
  EXPECT_DOUBLE_EQ(one.at(500), std::sqrt(1 + .25 / .24));
  const RefractiveIndex two = RefractiveIndex::sellmeier({{1, .01}, {.5, 4}});
  EXPECT_DOUBLE_EQ(two.at(500), std::sqrt(1 + .25 / .24 - .125 / 3.75));
  EXPECT_TRUE(two.disperses());
}

TEST(Dispersion, AbbeGivesBackItsNumbers) {
  const double cases[][2] = {{1.5168, 64.17}, {1.78472, 25.68}, {2.417, 55.3}, {1.333, 55.7}};
  for (const auto& [n_d, v_d] : cases) {
    const RefractiveIndex n = RefractiveIndex::abbe(n_d, v_d);
    EXPECT_NEAR(n.at(line_d), n_d, 1e-14);
    EXPECT_NEAR(abbe_number(n), v_d, 1e-9);
    EXPECT_TRUE(n.disperses());
  }
}

/// KHR_materials_dispersion: n = n_d + (n_d - 1) / V_d (523655 / lambda^2 - 1.5168).
TEST(Dispersion, AbbeIsTheFormulaOfGltf) {
  constexpr double dispersion = .3;
  const RefractiveIndex n = RefractiveIndex::abbe(1.5, 20 / dispersion);
  for (const double nm : {380.0, 550.0, 780.0})
    EXPECT_NEAR(n.at(nm), 1.5 + .5 * dispersion / 20 * (523655 / (nm * nm) - 1.5168), 1e-6);
}

TEST(Dispersion, TableIsLinearAndHoldsItsEnds) {
  const RefractiveIndex n = RefractiveIndex::table({{400, 1.6}, {500, 1.5}, {700, 1.4}});
  EXPECT_DOUBLE_EQ(n.at(450), 1.55);
  EXPECT_DOUBLE_EQ(n.at(650), 1.425);
  EXPECT_DOUBLE_EQ(n.at(360), 1.6);
  EXPECT_DOUBLE_EQ(n.at(830), 1.4);
  EXPECT_TRUE(n.disperses());
}

TEST(Dispersion, KnowsWhenThereIsNone) {
  EXPECT_FALSE(RefractiveIndex::cauchy(1.5, 0).disperses());
  EXPECT_FALSE(RefractiveIndex::abbe(1.5, infinity).disperses());
  EXPECT_FALSE(RefractiveIndex::abbe(1, 50).disperses());
  EXPECT_FALSE(RefractiveIndex::sellmeier({{1.25, 0}, {0, .01}}).disperses());
  EXPECT_FALSE(RefractiveIndex::table({{550, 1.5}}).disperses());
  EXPECT_FALSE(RefractiveIndex::table({{400, 1.5}, {700, 1.5}}).disperses());
  EXPECT_EQ(RefractiveIndex::abbe(1.5, infinity).at(400), 1.5);
  EXPECT_EQ(RefractiveIndex::sellmeier({{1.25, 0}}).at(400), 1.5);
  EXPECT_EQ(RefractiveIndex::sellmeier({}).at(400), 1);
  EXPECT_EQ(RefractiveIndex::table({{550, 1.5}}).at(400), 1.5);
}

TEST(Dispersion, RefusesWhatIsNoIndex) {
  const auto constant = [](double n) { return message_of([=] { RefractiveIndex::constant(n); }); };
  EXPECT_THAT(constant(0), HasSubstr("must be positive"));
  EXPECT_THAT(constant(-1.5), HasSubstr("must be positive"));
  EXPECT_THAT(constant(std::nan("")), HasSubstr("must be positive"));
  EXPECT_THAT(constant(infinity), HasSubstr("must be positive"));
  EXPECT_THAT(message_of([] { RefractiveIndex::cauchy(1.5, -2e5); }),
              AllOf(HasSubstr("B = -200000"), HasSubstr("at 360 nm")));
  EXPECT_THAT(message_of([] { RefractiveIndex::cauchy(-.2, 1e5); }), HasSubstr("at 708 nm"));
  EXPECT_THAT(message_of([] { RefractiveIndex::cauchy(1.5, infinity); }), HasSubstr("inf"));
}

TEST(Dispersion, RefusesPolesInTheVisibleRange) {
  const auto sellmeier = [](double b, double c) {
    return message_of([=] { RefractiveIndex::sellmeier({{b, c}}); });
  };
  EXPECT_THAT(sellmeier(1, .3), AllOf(HasSubstr("pole at 547.7 nm"), HasSubstr("360 to 830 nm")));
  EXPECT_THAT(sellmeier(1, .36 * .36), HasSubstr("pole at 360 nm"));
  EXPECT_THAT(sellmeier(1, -.01), HasSubstr("must not be negative"));
  EXPECT_THAT(sellmeier(1, std::nan("")), HasSubstr("not finite"));
  EXPECT_THAT(sellmeier(infinity, .01), HasSubstr("not finite"));
  // Beyond the pole n^2 may be negative: here between 592 nm and the pole at 837.
  EXPECT_THAT(sellmeier(1, .7), HasSubstr("at 592 nm"));
  EXPECT_THAT(sellmeier(-2, .01), HasSubstr("Sellmeier's formula"));
}

TEST(Dispersion, RefusesBadAbbeNumbersAndTables) {
  for (const double v_d : {0.0, -50.0, std::nan("")})
    EXPECT_THAT(message_of([=] { RefractiveIndex::abbe(1.5, v_d); }), HasSubstr("Abbe's number"));
  EXPECT_THAT(message_of([] { RefractiveIndex::abbe(-1.5, 50); }), HasSubstr("n_d = -1.5"));
  EXPECT_THAT(message_of([] { RefractiveIndex::abbe(1.5, .1); }), HasSubstr("Abbe's number 0.1"));
  EXPECT_THAT(message_of([] { RefractiveIndex::table({{400, 1.5}, {500, 0}}); }),
              HasSubstr("0 at 500 nm"));
  EXPECT_THROW(RefractiveIndex::table({}), UsageError);
  EXPECT_THROW(RefractiveIndex::table({{500, 1.5}, {400, 1.6}}), UsageError);
}

}  // namespace
}  // namespace mlt::test
