// The energy, symmetry and closed forms of the OpenPBR material.
#include "math/fresnel.h"
#include "scene/bsdf/bsdf_testing.h"
#include "scene/bsdf/openpbr_diffuse.h"
#include "scene/bsdf/openpbr_fuzz.h"
#include "scene/bsdf/openpbr_metal.h"
#include "scene/bsdf/thin_film.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

Vec3 direction(double cosine) {
  const double side = cosine < 0 ? -1 : 1, sine = std::sqrt(1 - sqr(cosine));
  return {0.8 * sine, 0.6 * sine, side * std::abs(cosine)};
}

/// The share of light from wl that is scattered, by a lattice of random numbers.
Spectrum scattered_share(const Bsdf& bsdf, const Vec3& wl, int samples) {
  constexpr double plastic[] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  Spectrum sum(0);
  for (int i = 0; i < samples; ++i) {
    const auto number = [&](int k) { return std::fmod(0.5 + (i + 1) * plastic[k], 1.0); };
    if (const auto s = bsdf.sample(point(), wl, {number(0), number(1), number(2)}))
      sum += weight_from_light(bsdf, wl, *s);
  }
  return sum / samples;
}

void expect_white(const Given& given, bool two_sided, double tolerance, double most = 1.004,
                  int samples = 1 << 16) {
  for (double roughness : {0.05, 0.2, 0.5, 0.8, 1.0}) {
    Given all = given;
    all.push_back({"base_color", 1.0});
    all.push_back({"specular_roughness", roughness});
    all.push_back({"coat_roughness", roughness});
    all.push_back({"fuzz_roughness", roughness});
    const BsdfPtr bsdf = make_bsdf("openpbr", all);
    for (double cosine : {0.1, 0.4, 0.8, 1.0, -0.1, -0.7, -1.0}) {
      if (cosine < 0 && !two_sided) continue;
      const Spectrum share = scattered_share(*bsdf, direction(cosine), samples);
      for (int k = 0; k < 3; ++k) {
        EXPECT_LE(share[k], most) << "roughness " << roughness << ", cos " << cosine;
        EXPECT_GE(share[k], 1 - tolerance) << "roughness " << roughness << ", cos " << cosine;
      }
    }
  }
}

TEST(OpenPbr, WhiteDielectricsAreWhiteInAWhiteFurnace) { expect_white({}, false, 0.004); }

TEST(OpenPbr, RoughWhiteDielectricsAreWhiteInAWhiteFurnace) {
  expect_white({{"base_diffuse_roughness", 1.0}}, false, 0.03);
}

TEST(OpenPbr, WhiteMetalsAreWhiteInAWhiteFurnace) {
  expect_white({{"base_metalness", 1.0}}, false, 0.004);
}

TEST(OpenPbr, StretchedWhiteMetalsAreAboutWhiteInAWhiteFurnace) {
  expect_white({{"base_metalness", 1.0}, {"specular_roughness_anisotropy", 0.7}}, false, 0.06,
               1.04);
}

TEST(OpenPbr, WhiteCoatsAreWhiteInAWhiteFurnace) {
  expect_white({{"coat_weight", 1.0}}, false, 0.006);
}

TEST(OpenPbr, WhiteFuzzIsWhiteInAWhiteFurnace) {
  expect_white({{"fuzz_weight", 1.0}}, false, 0.03);
}

TEST(OpenPbr, GlassIsWhiteInAWhiteFurnace) {
  expect_white({{"transmission_weight", 1.0}}, true, 0.02, 1.004, 1 << 18);
}

TEST(OpenPbr, ThinWallsAreWhiteInAWhiteFurnace) {
  const std::pair<std::string, Value> thin{"geometry_thin_walled", true};
  expect_white({thin, {"transmission_weight", 1.0}}, true, 0.05);
  expect_white({thin, {"subsurface_weight", 1.0}, {"subsurface_color", 1.0}}, true, 0.01);
}

TEST(OpenPbr, CoatedGlassKeepsItsLight) {
  const BsdfPtr glass = make_bsdf("openpbr", {{"transmission_weight", 1.0},
                                              {"specular_roughness", 0.05},
                                              {"coat_weight", 1.0},
                                              {"coat_roughness", 0.05}});
  for (double cosine : {1.0, 0.5, -0.5, -0.9, -1.0}) {
    const double share = scattered_share(*glass, direction(cosine), 1 << 16)[0];
    EXPECT_GT(share, 0.97) << cosine;
    EXPECT_LT(share, 1.004) << cosine;
  }
}

TEST(OpenPbr, MetalsHaveTheirTintAtTheCosineOfOneSeventh) {
  const Spectrum f0(0.9, 0.6, 0.3, 0.6), tint(0.5, 0.7, 0.9, 0.7);
  const double w = std::pow(6. / 7, 5);
  const Spectrum schlick = f0 + w * (Spectrum(1) - f0),
                 edge = MetalColors(f0, tint).at(MetalAngle<double>(1. / 7));
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(edge[k], tint[k] * schlick[k], 1e-12);
  double mean = 0;
  constexpr int steps = 10000;
  for (int i = 0; i < steps; ++i)
    mean += MetalColors(f0, tint).at(MetalAngle<double>(std::sqrt((i + 0.5) / steps)))[0] / steps;
  EXPECT_NEAR(MetalColors(f0, tint).mean()[0], mean, 1e-6);
}

TEST(OpenPbr, RoughDiffuseSurfacesKeepTheirLight) {
  const EnergyPreservingOrenNayar<double> clay(0.7);
  constexpr int steps = 800;
  for (double cosine : {0.1, 0.5, 1.0}) {
    double once = 0, twice = 0;
    for (int i = 0; i < steps; ++i)
      for (int k = 0; k < steps; ++k) {
        const Vec3 w = sample_cosine_hemisphere(Vec2((i + 0.5) / steps, (k + 0.5) / steps));
        const auto f = clay.eval(direction(cosine), w);
        once += pi * f.once / (steps * steps);
        twice += pi * f.twice / (steps * steps);
      }
    EXPECT_NEAR(once, clay.albedo(cosine), 2e-3);
    EXPECT_NEAR(once + twice, 1, 2e-3);
  }
}

/// How far the symmetric fuzz is from the lobe as seen from the camera, which is MaterialX's.
TEST(OpenPbr, FuzzReflectsAboutAsTheLobeThatIsNotSymmetric) {
  for (double roughness : {0.5, 0.6, 0.8, 1.0})
    for (double cosine : {0.1, 0.3, 0.7}) {
      const Vec3 w = direction(cosine);
      const FuzzLobe<double> lobe(w, roughness);
      const double theirs = lobe.brdf(w) / lobe.density(w) * w.z;
      EXPECT_NEAR(fuzz_reflectance().at(cosine, roughness), theirs, 0.07) << roughness << cosine;
    }
}

TEST(OpenPbr, AFilmOfTheIndexOfItsBaseIsNotSeen) {
  const ThinFilm film(400, 1.5, 1.5);
  for (double cosine : {0.1, 0.5, 1.0}) {
    const double F = fresnel_dielectric(cosine, 1.5).reflectance;
    EXPECT_NEAR(film.dielectric(cosine, 550)[0], F, 1e-12);
  }
  EXPECT_NEAR(film.dielectric(1, rgb_lanes)[0], 0.04, 1e-9);
}

TEST(OpenPbr, AFilmWithoutThicknessOnAMetalIsNotSeen) {
  const ThinFilm film(0, 1.4, 1.5);
  for (double cosine : {0.1, 0.5, 1.0})
    for (double bare : {0.1, 0.5, 0.9})
      EXPECT_NEAR(film.metal(cosine, 550, Spectrum(bare))[0], bare, 1e-9) << cosine;
}

/// r = (r12 - r23) / (1 - r12 r23), where r12 = -1/6, and r23 with r12 makes the bare -sqrt(1/2).
TEST(OpenPbr, AQuarterWaveFilmDarkensAMetal) {
  const double nm = 550, index = 1.4, r12 = -1. / 6, bare = -std::sqrt(0.5);
  const double r23 = (bare - r12) / (1 - bare * r12);
  const ThinFilm film(nm / (4 * index), index, 1.5);
  EXPECT_NEAR(film.metal(1, nm, Spectrum(0.5))[0], sqr((r12 - r23) / (1 - r12 * r23)), 1e-9);
}

/// A quarter of a wave, with the index sqrt(n): no reflection (Born & Wolf, sec. 1.6.4).
TEST(OpenPbr, AQuarterWaveFilmTakesTheReflectionAway) {
  const double n = 1.5, index = std::sqrt(n), nm = 550;
  const ThinFilm film(nm / (4 * index), index, n);
  EXPECT_LT(film.dielectric(1, nm)[0], 1e-12);
  EXPECT_GT(film.dielectric(1, 400)[0], 1e-3);
}

TEST(OpenPbr, SolidsBringTheirMedium) {
  EXPECT_FALSE(make_bsdf("openpbr")->inside());
  EXPECT_FALSE(make_bsdf("openpbr", {{"transmission_weight", 1.0}})->inside());
  const auto wine = make_bsdf("openpbr", {{"transmission_weight", 1.0},
                                          {"transmission_color", Triple{0.5, 0.1, 0.2}},
                                          {"transmission_depth", 2.0}})
                        ->inside();
  ASSERT_TRUE(wine);
  EXPECT_NEAR(wine->absorption.x, -std::log(0.5) / 2, 1e-12);
  EXPECT_EQ(wine->scattering.x, 0);
  const auto wax = make_bsdf("openpbr", {{"subsurface_weight", 1.0},
                                         {"subsurface_radius", 0.1},
                                         {"subsurface_scatter_anisotropy", 0.4}})
                       ->inside();
  ASSERT_TRUE(wax);
  EXPECT_NEAR(wax->scattering.y + wax->absorption.y, 1 / (0.1 * 0.5), 1e-9);
  EXPECT_EQ(wax->g, 0.4);
}

}  // namespace
}  // namespace mlt::test
