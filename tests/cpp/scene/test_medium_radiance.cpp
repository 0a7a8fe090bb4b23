#include <gtest/gtest.h>

#include "math/curve.h"
#include "math/planck.h"
#include "math/wavelengths.h"
#include "scene/medium/medium.h"
#include "scene/plugin_testing.h"
#include "scene/volume/grid_volume.h"

namespace mlt {

Plugin medium_heterogeneous();

namespace {

using test::make;

/// A medium that only absorbs, of extinction 1, so that it emits its radiance; its temperatures
/// rise from 0 to 3000 along x.
MediumPtr fire(test::Given given) {
  const GridData data{{4, 1, 1}, 1, {0, 1000, 2000, 3000}};
  const ObjectPtr grid = std::make_shared<GridVolume>(Grid(data, false, "test"), Mat4(1));
  given.insert({{"albedo", 0.0}, {"temperature", grid}});
  return make<Medium>(medium_heterogeneous(), given);
}

/// Where the grid says `t`.
Vec3 place_of(double t) { return {(t / 1000 + 0.5) / 4, 0.5, 0.5}; }

void expect_black_body(const Medium& medium, const Vec3& p, const Curve& expected) {
  const Color rgb = glm::max(curve_to_rgb(expected), Color(0));
  test::expect_close(medium.emission(p, rgb_lanes).rgb(), rgb, 1e-3 * max_component(rgb));
  for (const double u : {0.1, 0.7, 620.0}) {
    const Spectrum found = medium.emission(p, u);
    const Spectrum at = at_wavelengths(u, [&](double nm) { return expected.at(nm); });
    for (int i = 0; i < Spectrum::lanes; ++i) EXPECT_NEAR(found[i], at[i], 1e-6 * at[i]) << u;
  }
}

TEST(MediumRadiance, IsThatOfABlackBody) {
  const MediumPtr medium = fire({});
  EXPECT_TRUE(medium->emits());
  for (const double kelvin : {1000.0, 1250.0, 1999.0, 3000.0})
    expect_black_body(*medium, place_of(kelvin), Curve::blackbody(kelvin));
  EXPECT_TRUE(is_black(medium->emission(place_of(499), rgb_lanes)));
  EXPECT_TRUE(is_black(medium->emission(place_of(499), 0.5)));
}

TEST(MediumRadiance, OffsetComesBeforeTheScale) {
  const MediumPtr medium =
      fire({{"temperature_offset", 200.0}, {"temperature_scale", 0.75}, {"emission_scale", 3.0}});
  expect_black_body(*medium, place_of(2200), Curve::blackbody(1500).scaled(3));
}

TEST(MediumRadiance, CanBeDividedByItsGreatestValue) {
  const MediumPtr medium = fire({{"temperature_normalized", true}});
  const double kelvin = 2500;
  double greatest = 0;
  for (double nm = 900; nm < 1500; nm += 0.5)
    greatest = std::max(greatest, planck_radiance(nm, kelvin));
  expect_black_body(*medium, place_of(kelvin), Curve::blackbody(kelvin).scaled(1 / greatest));
}

TEST(MediumRadiance, ColdSmokeIsDark) {
  EXPECT_FALSE(fire({{"temperature_scale", 0.1}})->emits());
  EXPECT_FALSE(fire({{"emission_scale", 0.0}})->emits());
}

TEST(MediumRadiance, RefusesWhatIsNoTemperature) {
  const auto error = [](const test::Given& given) {
    return test::error_in(medium_heterogeneous(), given);
  };
  EXPECT_NE(error({{"temperature", Triple{1000, 2000, 3000}}}).find("one number"),
            std::string::npos);
  EXPECT_NE(error({{"temperature", 900.0}, {"emission", 1.0}}).find("exclude each other"),
            std::string::npos);
  EXPECT_NE(error({{"temperature", 900.0}, {"temperature_scale", 1e4}}).find("at most 1e+06 K"),
            std::string::npos);
}

}  // namespace
}  // namespace mlt
