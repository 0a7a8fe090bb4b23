// Smooth spectra of RGB colours: there and back, and against another implementation's fits.
#include "math/upsampling.h"

#include "math/colorimetry.h"

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include <array>
#include <random>
#include <vector>

namespace mlt::test {
namespace {

/// The colour under D65, by a quadrature finer than that of the fit.
Color seen(const SmoothReflectance& spectrum) {
  constexpr double step = 0.5;
  Vec3 xyz(0.0);
  for (double w = first_wavelength; w <= last_wavelength; w += step)
    xyz += matching_functions(w) * (d65(w) * spectrum.at(w) * step);
  return xyz_to_srgb(xyz);
}

double largest_difference(const Color& a, const Color& b) { return max_component(glm::abs(a - b)); }

/// Of the wavelengths that decide the colour.
double largest_difference(const SmoothReflectance& a, const SmoothReflectance& b) {
  double largest = 0;
  for (double w = 400; w <= 700; w += 5) largest = std::max(largest, std::abs(a.at(w) - b.at(w)));
  return largest;
}

/// All of [0, 1]^3 with its faces, edges and corners, and a colour that one fit from grey misses.
std::vector<Color> grid() {
  std::vector<Color> colors{{3.62033322e-07, 0.285820648, 3.62033322e-07}};
  const std::array<double, 9> values{0, 1e-3, 0.02, 0.1, 0.3, 0.6, 0.9, 0.999, 1};
  for (const double r : values)
    for (const double g : values)
      for (const double b : values) colors.push_back({r, g, b});
  return colors;
}

std::vector<Color> random_colors(size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  std::vector<Color> colors(count);
  for (Color& c : colors) c = {uniform(random), uniform(random), uniform(random)};
  return colors;
}

TEST(Upsampling, FitsHaveTheirColour) {
  for (const Color& c : grid())
    EXPECT_LT(largest_difference(seen(fit_reflectance(c)), c), 2e-3)
        << c.x << " " << c.y << " " << c.z;
  for (const Color& c : random_colors(500))
    EXPECT_LT(largest_difference(seen(fit_reflectance(c)), c), 5e-4)
        << c.x << " " << c.y << " " << c.z;
}

TEST(Upsampling, TheTableHasItsColours) {
  const ReflectanceTable& table = ReflectanceTable::get();
  for (const Color& c : grid())
    EXPECT_LT(largest_difference(seen(table.at(c)), c), 5e-3) << c.x << " " << c.y << " " << c.z;
  for (const Color& c : random_colors(5000))
    EXPECT_LT(largest_difference(seen(table.at(c)), c), 3e-3) << c.x << " " << c.y << " " << c.z;
}

TEST(Upsampling, DarkColoursKeepTheirHue) {
  for (const double scale : {1e-2, 1e-4, 1e-9})
    for (const Color& c : random_colors(200)) {
      EXPECT_LT(largest_difference(seen(fit_reflectance(scale * c)) / scale, c), 2e-3);
      EXPECT_LT(largest_difference(seen(ReflectanceTable::get().at(scale * c)) / scale, c), 2e-2);
    }
}

TEST(Upsampling, TheTableHasTheSpectraOfFits) {
  for (const Color& c : random_colors(1000))
    EXPECT_LT(largest_difference(ReflectanceTable::get().at(c), fit_reflectance(c)), 0.03)
        << c.x << " " << c.y << " " << c.z;
}

TEST(Upsampling, GreysAreFlat) {
  for (const double grey : {0.0, 1e-9, 1e-3, 0.18, 0.5, 0.75, 0.999, 1.0})
    for (const SmoothReflectance& spectrum :
         {fit_reflectance(Color(grey)), ReflectanceTable::get().at(Color(grey))}) {
      EXPECT_EQ(spectrum.c0, 0);
      EXPECT_EQ(spectrum.c1, 0);
      EXPECT_NEAR(spectrum.at(555), grey, 1e-6);
    }
}

TEST(Upsampling, NearlyGreyIsNearlyFlat) {
  for (const double grey : {1e-4, 0.18, 0.5, 0.75, 0.99, 1.0}) {
    const Color nearly{grey, grey * (1 - 1e-9), grey};
    for (double w = first_wavelength; w <= last_wavelength; w += 10) {
      const double bound = grey < 0.9 ? 1e-6 : 1e-3;
      EXPECT_NEAR(fit_reflectance(nearly).at(w), grey, bound) << grey << " " << w;
      EXPECT_NEAR(ReflectanceTable::get().at(nearly).at(w), grey, 2e-3) << grey << " " << w;
    }
  }
}

TEST(Upsampling, ReflectancesAreProper) {
  for (const Color& c : grid())
    for (const SmoothReflectance& spectrum : {fit_reflectance(c), ReflectanceTable::get().at(c)})
      for (double w = first_wavelength; w <= last_wavelength; w += 10) {
        EXPECT_GT(spectrum.at(w), 0);
        EXPECT_LT(spectrum.at(w), 1);
      }
}

TEST(Upsampling, ColoursOutsideAreClamped) {
  const Color outside{1.5, 0.4, -0.2}, inside{1, 0.4, 0};
  EXPECT_EQ(largest_difference(fit_reflectance(outside), fit_reflectance(inside)), 0);
  const ReflectanceTable& table = ReflectanceTable::get();
  EXPECT_EQ(largest_difference(table.at(outside), table.at(inside)), 0);
  EXPECT_EQ(table.at(Color(std::nan(""))).at(555), table.at(Color(0.0)).at(555));
}

struct Reference {
  Color rgb;
  std::array<double, 6> values;  // at 420, 480, 540, 600, 660 and 720 nm
};

/// From colour-science 0.4.7: `colour.recovery.jakob2019.find_coefficients_Jakob2019`, for XYZ by
/// the inverse of xyz_to_srgb, with max_error = 1e-3 (of Delta E 1976), from 360 to 780 nm.
const std::vector<Reference> references{
    {{0.8, 0.2, 0.1}, {0.1366, 0.1196, 0.1916, 0.5537, 0.9163, 0.9797}},
    {{0.1, 0.6, 0.2}, {0.0710, 0.4068, 0.6018, 0.2843, 0.0432, 0.0093}},
    {{0.15, 0.2, 0.7}, {0.8436, 0.4650, 0.2166, 0.1640, 0.2055, 0.4249}},
    {{0.7, 0.6, 0.1}, {0.0608, 0.2609, 0.5963, 0.6791, 0.5087, 0.1651}},
    {{0.1, 0.5, 0.6}, {0.5245, 0.6042, 0.5057, 0.2570, 0.0849, 0.0294}},
    {{0.6, 0.15, 0.5}, {0.7765, 0.2687, 0.1787, 0.3619, 0.8748, 0.9799}},
    {{0.3, 0.35, 0.25}, {0.2069, 0.2985, 0.3467, 0.3268, 0.2487, 0.1540}},
    {{0.9, 0.85, 0.7}, {0.6328, 0.7724, 0.8441, 0.8804, 0.8986, 0.9063}},
    {{0.05, 0.02, 0.03}, {0.0413, 0.0235, 0.0217, 0.0308, 0.0890, 0.7345}},
    {{0.5, 0.3, 0.2}, {0.1963, 0.2315, 0.2976, 0.4099, 0.5703, 0.7352}},
    {{0.25, 0.5, 0.75}, {0.7821, 0.6629, 0.5069, 0.3524, 0.2355, 0.1595}},
    {{0.63, 0.065, 0.05}, {0.0822, 0.0534, 0.0759, 0.3279, 0.9321, 0.9888}},
};

TEST(Upsampling, AgreesWithColourScience) {
  for (const Reference& reference : references)
    for (size_t i = 0; i < reference.values.size(); ++i) {
      const double w = 420 + 60 * static_cast<double>(i);
      const Color& c = reference.rgb;
      EXPECT_NEAR(fit_reflectance(c).at(w), reference.values[i], 0.01)
          << c.x << " " << c.y << " " << c.z << " at " << w;
      EXPECT_NEAR(ReflectanceTable::get().at(c).at(w), reference.values[i], 0.02)
          << c.x << " " << c.y << " " << c.z << " at " << w;
    }
}

}  // namespace
}  // namespace mlt::test
