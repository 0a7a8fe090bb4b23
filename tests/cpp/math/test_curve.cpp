// Functions of the wavelength against closed forms and against the conversion of tables.
#include "math/curve.h"

#include "base/error.h"
#include "math/colorimetry.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

TEST(Curve, ConstantIsItsValueEverywhere) {
  const Curve curve = Curve::constant(0.25);
  for (const double w : {0.1, 360.0, 555.5, 5000.0}) EXPECT_EQ(curve.at(w), 0.25);
  EXPECT_EQ(curve.maximum(), 0.25);
  EXPECT_EQ(Curve::table(constant_spectrum(0.25)).at(900), 0.25);
  EXPECT_EQ(Curve::held_table(constant_spectrum(0.25)).at(100), 0.25);
}

TEST(Curve, TablesOfEqualAndUnequalStepsAreLinearBetweenPairs) {
  const WavelengthTable equal{{400, 1}, {450, 3}, {500, 0}, {550, 2}};
  WavelengthTable unequal = equal;
  unequal.insert(unequal.begin() + 1, {410, 1.4});  // on the line from 400 to 450 nm
  const Curve a = Curve::table(equal), b = Curve::table(unequal);
  for (const auto& [w, value] : unequal) {
    EXPECT_NEAR(a.at(w), value, 1e-14) << w;
    EXPECT_NEAR(b.at(w), value, 1e-14) << w;
  }
  for (double w = 390; w < 560; w += 0.37) EXPECT_NEAR(a.at(w), b.at(w), 1e-12) << w;
  EXPECT_NEAR(a.at(425), 2, 1e-14);
  EXPECT_NEAR(a.at(540), 1.6, 1e-14);
}

TEST(Curve, IsZeroOutsideOfATableUnlessItIsHeld) {
  const WavelengthTable samples{{400, 1}, {500, 2}, {700, 4}};
  const Curve zero = Curve::table(samples), held = Curve::held_table(samples);
  EXPECT_EQ(zero.at(399.999), 0);
  EXPECT_EQ(zero.at(700.001), 0);
  EXPECT_EQ(held.at(399.999), 1);
  EXPECT_EQ(held.at(700.001), 4);
  for (const double w : {400.0, 444.0, 700.0}) EXPECT_EQ(zero.at(w), held.at(w));
}

TEST(Curve, TableShowsAsTheSameColourAsItsPairs) {
  for (const WavelengthTable& samples :
       {WavelengthTable{{360, 0.3}, {500, 0.7}, {590, 0.5}, {900, 0.8}},
        WavelengthTable{{300, 0.3}, {500, 0.7}, {700, 0.5}, {900, 0.8}}}) {
    const Color expected = spectrum_to_rgb(samples, SpectrumUse::emission).color;
    EXPECT_LT(length(curve_to_rgb(Curve::table(samples)) - expected), 1e-12);
  }
}

TEST(Curve, D65IsTheWhiteOfSrgb) {
  const Curve curve = Curve::d65();
  for (double w = first_wavelength; w <= last_wavelength; w += 0.7)
    EXPECT_NEAR(curve.at(w), d65(w), 1e-12) << w;
  const Color white = curve_to_rgb(curve);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(white[k], 1, 2e-3);
}

// 2 h c^2 = 1.191042972e-16 W m^2 and h c / k = 1.438776877e-2 m K (CODATA 2018).
TEST(Curve, BlackBodyFollowsPlanck) {
  for (const double kelvin : {2856.0, 6504.0})
    for (const double w : {360.0, 560.0, 830.0, 2000.0}) {
      const double expected =
          1.191042972e-16 * 1e36 / std::pow(w, 5) / (std::exp(1.438776877e7 / (w * kelvin)) - 1);
      EXPECT_NEAR(Curve::blackbody(kelvin).at(w) / expected, 1, 1e-8) << kelvin << " " << w;
    }
}

TEST(Curve, BlackBodyFollowsWien) {
  for (const double kelvin : {1500.0, 4000.0, 5778.0}) {
    const Curve curve = Curve::blackbody(kelvin);
    const double peak = 2.897771955e6 / kelvin;
    EXPECT_GT(curve.at(peak), curve.at(peak * 1.001));
    EXPECT_GT(curve.at(peak), curve.at(peak * 0.999));
  }
}

// The integral over all wavelengths is sigma T^4 / pi (Stefan and Boltzmann).
TEST(Curve, BlackBodyFollowsStefanAndBoltzmann) {
  const Curve curve = Curve::blackbody(5000);
  double sum = 0;
  constexpr double step = 1e-3;  // of the logarithm of the wavelength
  for (double t = std::log(50.0); t < std::log(1e6); t += step) {
    const double w = std::exp(t);
    sum += curve.at(w) * w * step;
  }
  EXPECT_NEAR(sum / (5.670374419e-8 * std::pow(5000.0, 4) * inv_pi), 1, 1e-5);
}

TEST(Curve, BlackBodyIsRedderWhenItIsColder) {
  const Color cold = curve_to_rgb(Curve::blackbody(3000));
  const Color hot = curve_to_rgb(Curve::blackbody(12000));
  EXPECT_GT(cold.x, 2 * cold.z);
  EXPECT_GT(hot.z, hot.x);
}

TEST(Curve, MaximumIsThatOfVisibleWavelengths) {
  EXPECT_EQ(Curve::table({{300, 9}, {360, 1}, {500, 3}, {900, 2}}).maximum(), 3);
  EXPECT_EQ(Curve::table({{400, -1}, {500, -3}}).maximum(), 0);
  EXPECT_EQ(Curve::table({{300, 9}, {350, 9}}).maximum(), 0);
  EXPECT_EQ(Curve::held_table({{300, 9}, {350, 9}}).maximum(), 9);
  for (const double kelvin : {1000.0, 5000.0, 20000.0}) {
    const Curve curve = Curve::blackbody(kelvin);
    double largest = 0;
    for (double w = first_wavelength; w <= last_wavelength; w += 0.5)
      largest = std::max(largest, curve.at(w));
    EXPECT_NEAR(curve.maximum() / largest, 1, 1e-5) << kelvin;
  }
}

TEST(Curve, ScalesEveryForm) {
  for (const Curve& curve : {Curve::constant(0.5), Curve::d65(), Curve::blackbody(5000),
                             Curve::table({{400, 1}, {500, 2}, {700, 4}})}) {
    EXPECT_DOUBLE_EQ(curve.scaled(3).at(555), 3 * curve.at(555));
    EXPECT_DOUBLE_EQ(curve.scaled(3).maximum(), 3 * curve.maximum());
  }
}

TEST(Curve, RefusesBadInput) {
  for (const auto make : {Curve::table, Curve::held_table}) {
    EXPECT_THROW(make({}), UsageError);
    EXPECT_THROW(make({{500, 1}, {500, 2}}), UsageError);
    EXPECT_THROW(make({{500, 1}, {400, 2}}), UsageError);
    EXPECT_THROW(make({{500, 1}, {600, infinity}}), UsageError);
    EXPECT_THROW(make({{std::nan(""), 1}, {600, 1}}), UsageError);
    EXPECT_THROW(make({{550, infinity}}), UsageError);
  }
  EXPECT_THROW(Curve::constant(std::nan("")), UsageError);
  for (const double kelvin : {0.0, -5.0, infinity, std::nan("")})
    EXPECT_THROW(Curve::blackbody(kelvin), UsageError) << kelvin;
}

}  // namespace
}  // namespace mlt::test
