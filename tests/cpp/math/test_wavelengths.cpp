// What a film records of the wavelengths of paths, against the colours of their spectra.
#include "math/wavelengths.h"

#include "math/colorimetry.h"
#include "math/curve.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

/// The mean over u of what a film shows of such light.
Color shown(const Curve& light, bool dispersed) {
  constexpr int points = 20'000;
  Color sum(0);
  for (int i = 0; i < points; ++i) {
    const double u = (i + 0.5) / points;
    sum += recorded(at_wavelengths(u, [&](double nm) { return light.at(nm); }), u, dispersed);
  }
  return developed(sum / double(points));
}

/// Films do not have the error of the quadrature by which curve_to_rgb() finds colours, as Mitsuba:
/// it is the same for all spectra.
void expect_shown(const Curve& light) {
  const Color expected = curve_to_rgb(light) / xyz_of(d65).y;
  for (const bool dispersed : {false, true}) {
    const Color color = shown(light, dispersed);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(color[i], expected[i], 1e-3 * max_component(expected)) << dispersed;
  }
}

TEST(Wavelengths, ShowTheColoursOfSpectra) {
  expect_shown(Curve::d65());
  expect_shown(Curve::constant(1));
  expect_shown(Curve::blackbody(2000));
  expect_shown(Curve::table({{400, 0.9}, {500, 0.1}, {600, 0.7}, {700, 0.3}}));
}

TEST(Wavelengths, AreOneInEachQuarterOfTheRange) {
  for (const double u : {0.0, 0.1, 0.3, 0.6, 0.99}) {
    std::array<int, 4> found{};
    for (int j = 0; j < 4; ++j) {
      const double nm = wavelengths::Place(u).at(wavelengths::tables.nm, j);
      for (const double border : {0.25, 0.5, 0.75}) found[j] += nm >= wavelength_of(border);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, (std::array<int, 4>{0, 1, 2, 3})) << u;
  }
}

/// Daylight is tabulated for u, in cells that are wide where the eye sees little.
TEST(Wavelengths, HaveTheDaylightOfTheTables) {
  constexpr int points = 20'000;
  Color white(0);
  for (int i = 0; i < points; ++i) {
    const double u = (i + 0.5) / points;
    white += recorded(daylight(u), u) / double{points};
    if (wavelength_of(u) > 430 && wavelength_of(u) < 680) {
      EXPECT_NEAR(daylight(u)[0], d65(wavelength_of(u)), 0.006) << u;
    }
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 2e-5) << c;
  EXPECT_EQ(daylight(555)[3], d65(555));
}

/// The first lane stands for all wavelengths where glass sends them four ways.
TEST(Wavelengths, OfDispersedPathsTheFirstAloneCounts) {
  for (const double u : {0.1, 0.4, 0.8}) {
    const Color alone = recorded(Spectrum(0.5, 0, 0, 0), u, true);
    EXPECT_EQ(recorded(Spectrum(0.5, 0.3, 0.9, 0.2), u, true), alone);
    EXPECT_EQ(4.0 * recorded(Spectrum(0.5, 0, 0, 0), u), alone);
  }
}

}  // namespace
}  // namespace mlt::test
