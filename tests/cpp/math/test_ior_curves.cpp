// Named indices by wavelength against catalogues, and against the colours that RGB scenes have.
#include "math/ior_curves.h"

#include "math/colorimetry.h"
#include "math/ior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mlt::test {
namespace {

struct Catalogue {
  const char* name;
  double n_d, n_error, v_d, v_error;  // the errors are half of the last digit, or of the spread
};

/// Schott's data sheets; Malitson 1965; Dodge 1986; Li 1976; Warren & Brandt 2008, of whose table
/// we have a part of the rows; for water the tables of the IAPWS, 1.33299 at line D against air.
constexpr Catalogue catalogue[] = {
    {"bk7", 1.51680, 5e-6, 64.17, .005},         {"sf11", 1.78472, 5e-6, 25.68, .005},
    {"fused quartz", 1.45846, 1e-5, 67.8, .1},   {"sapphire", 1.7682, 1e-4, 72.2, .3},
    {"diamond", 2.4175, 5e-4, 55.3, .5},         {"water", 1.3330, 5e-4, 55.7, .5},
    {"sodium chloride", 1.5443, 3e-4, 42.9, .3}, {"water ice", 1.3098, 1e-4, 53, 1.5},
};

TEST(IorCurves, DielectricsAreThoseOfCatalogues) {
  for (const Catalogue& c : catalogue) {
    const RefractiveIndex n = find_dispersive(c.name).value();
    EXPECT_NEAR(n.at(line_d), c.n_d, c.n_error) << c.name;
    EXPECT_NEAR((n.at(line_d) - 1) / (n.at(line_f) - n.at(line_c)), c.v_d, c.v_error) << c.name;
    for (double nm = first_wavelength; nm < last_wavelength; ++nm)
      EXPECT_GT(n.at(nm), n.at(nm + 1)) << c.name << " at " << nm;
  }
  EXPECT_NEAR(find_dispersive("diamond")->sodium(), 2.417, 5e-4);
}

/// Schott's data sheet at the lines i and r, and of the helium-neon laser.
TEST(IorCurves, Bk7IsSchotts) {
  const RefractiveIndex n = find_dispersive("bk7").value();
  EXPECT_NEAR(n.at(365.015), 1.53627, 1e-5);
  EXPECT_NEAR(n.at(632.8), 1.51509, 1e-5);
  EXPECT_NEAR(n.at(706.519), 1.51289, 1e-5);
}

TEST(IorCurves, EveryDielectricHasOne) {
  size_t dispersive = 0;
  for (const std::string& name : dielectric_names()) {
    const auto n = find_dispersive(name);
    ASSERT_TRUE(n) << name;
    dispersive += n->disperses();
    const double rgb = find_dielectric(name).value();
    const double difference = std::abs(n->sodium() - rgb);
    EXPECT_LE(difference, !n->disperses() ? 0 : name == "bk7" ? .0122 : .002) << name;
  }
  EXPECT_EQ(dispersive, std::size(catalogue));
  EXPECT_TRUE(find_dispersive("BK7")->disperses());
  EXPECT_TRUE(find_dispersive("Fused Quartz")->disperses());
  EXPECT_FALSE(find_dispersive("unobtainium"));
  EXPECT_FALSE(find_dispersive(""));
}

/// The colour of what was measured of a curve, every nm.
Color colour(const Curve& curve, const WavelengthTable& measured) {
  const double first = std::max(first_wavelength, measured.front().first);
  const double last = std::min(last_wavelength, measured.back().first);
  WavelengthTable pairs;
  for (double nm = first; nm < last; ++nm) pairs.emplace_back(nm, curve.at(nm));
  pairs.emplace_back(last, curve.at(last));
  return spectrum_to_rgb(pairs, SpectrumUse::emission).color;
}

void expect_near(const Color& actual, const Color& expected, const std::string& name) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(actual[c], expected[c], .01 * expected[c]) << name << ' ' << c;
}

/// The rule by which the colours were made takes what was not measured as 0. Within AlAs's table
/// there is a gap, where the colours have an eta of 0 and the curve goes on.
TEST(IorCurves, ConductorsHaveTheirColours) {
  for (const std::string& name : conductor_names()) {
    if (name == "none") continue;
    const ConductorTables tables = find_conductor_tables(name).value();
    const ConductorCurves curves = find_conductor_curves(name).value();
    const ComplexIor expected = find_conductor(name).value();
    if (name.substr(0, 4) != "AlAs")
      expect_near(colour(curves.eta, tables.eta), expected.eta, name + " eta");
    expect_near(colour(curves.k, tables.k), expected.k, name + " k");
  }
}

void expect_same(const Curve& curve, const WavelengthTable& table, const std::string& name) {
  for (const auto& [nm, value] : table) EXPECT_NEAR(curve.at(nm), value, 1e-6 * value) << name;
  EXPECT_EQ(curve.at(table.front().first - 50), table.front().second) << name;
  EXPECT_EQ(curve.at(table.back().first + 50), table.back().second) << name;
}

TEST(IorCurves, ConductorsFollowTheirTablesAndHoldTheEnds) {
  for (const std::string& name : conductor_names()) {
    if (name == "none") continue;
    const ConductorTables tables = find_conductor_tables(name).value();
    const ConductorCurves curves = find_conductor_curves(name).value();
    expect_same(curves.eta, tables.eta, name);
    expect_same(curves.k, tables.k, name);
    for (double nm = first_wavelength; nm <= last_wavelength; ++nm) {
      EXPECT_GT(curves.eta.at(nm), 0) << name << " at " << nm;
      EXPECT_GE(curves.k.at(nm), 0) << name << " at " << nm;
    }
  }
}

TEST(IorCurves, ConductorsByName) {
  EXPECT_EQ(find_conductor_curves("none")->eta.at(500), 0);
  EXPECT_EQ(find_conductor_curves("none")->k.at(500), 1);
  EXPECT_NEAR(find_conductor_curves("Au")->eta.at(652.55), .166, 1e-9);
  EXPECT_NEAR(find_conductor_curves("Ag")->k.at(652.55), 4.15, 1e-9);
  // Different measurements, and one set under both names.
  EXPECT_NE(find_conductor_curves("Cu")->k.at(500), find_conductor_curves("Cu_palik")->k.at(500));
  EXPECT_EQ(find_conductor_curves("Be")->k.at(500), find_conductor_curves("Be_palik")->k.at(500));
  for (const char* unknown : {"au", "Au_palik", "Na", "_palik", "", "unobtainium"})
    EXPECT_FALSE(find_conductor_curves(unknown)) << unknown;
}

}  // namespace
}  // namespace mlt::test
