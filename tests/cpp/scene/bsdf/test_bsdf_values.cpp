// Energy, symmetry and soundness of every material's values.
#include "harness/statistics.h"
#include "math/fresnel.h"
#include "scene/bsdf/bsdf_testing.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

/// Half of the directions lie anywhere, half close to where light scattered from `a` is strong.
Vec3 partner(const Bsdf& bsdf, const Vec3& a, Rng& rng) {
  if (rng.next() < 0.5) return random_direction(rng);
  const auto s = bsdf.sample(point(), a, random_u(rng));
  return s ? s->to : random_direction(rng);
}

void expect_close(double a, double b, double relative, const std::string& label) {
  EXPECT_LE(std::abs(a - b), relative * std::max(std::abs(a), std::abs(b))) << label;
}

void expect_same_density(const Case& c, const Vec3& wl, const Vec3& wc, Lobe lobe) {
  const Scattering forth = c.bsdf->scattering(point(), wl, wc, lobe);
  const Scattering back = c.bsdf->scattering(point(), wc, wl, lobe);
  expect_close(forth.pdf_from_camera, back.pdf_from_light, 1e-12, c.label);
  expect_close(forth.pdf_from_light, back.pdf_from_camera, 1e-12, c.label);
}

/// sample() does not know which side is the light's.
TEST(BsdfValues, DensitiesAreTheSameFromBothSides) {
  for (const Case& c : cases()) {
    Rng rng(1, Purpose::test, 0);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 wl = random_direction(rng);
      expect_same_density(c, wl, random_direction(rng), Lobe::smooth);
      if (const auto s = c.bsdf->sample(point(), wl, random_u(rng)))
        expect_same_density(c, wl, s->to, s->lobe);
    }
  }
}

/// f(wl, wc) / eta_c^2 is symmetric (Veach 1997, sec. 5.2), which is plain reciprocity on one side.
TEST(BsdfValues, SmoothLobesAreReciprocal) {
  for (const Case& c : cases()) {
    if (!c.symmetric) continue;
    Rng rng(2, Purpose::test, 0);
    int compared = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vec3 a = random_direction(rng), b = partner(*c.bsdf, a, rng);
      const double ratio = same_side(a, b) ? 1 : c.bsdf->relative_eta(point(), a);
      if (c.reciprocal) {
        EXPECT_EQ(ratio, 1) << c.label;
      }
      const Spectrum forth = sqr(ratio) * c.bsdf->eval(point(), a, b, Lobe::smooth);
      const Spectrum back = c.bsdf->eval(point(), b, a, Lobe::smooth);
      for (int k = 0; k < 3; ++k) expect_close(forth[k], back[k], 1e-7, c.label);
      compared += !is_black(forth);
    }
    EXPECT_EQ(compared > 100, c.bsdf->has_smooth()) << c.label;
  }
}

TEST(BsdfValues, DeltaLobesCarryTheSameFractionBothWays) {
  for (const Case& c : cases()) {
    if (!c.symmetric) continue;
    Rng rng(3, Purpose::test, 0);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 a = random_direction(rng);
      const auto s = c.bsdf->sample(point(), a, random_u(rng));
      if (!s || s->lobe == Lobe::smooth) continue;
      const Spectrum forth = c.bsdf->eval(point(), a, s->to, s->lobe);
      const Spectrum back = c.bsdf->eval(point(), s->to, a, s->lobe);
      for (int k = 0; k < 3; ++k) expect_close(forth[k], back[k], 1e-9, c.label);
    }
  }
}

TEST(BsdfValues, RelativeEtaIsThatOfTheSide) {
  const double eta = 1.5046 / 1.000277;
  for (const char* name : {"dielectric", "roughdielectric"}) {
    const BsdfPtr glass = make_bsdf(name);
    EXPECT_DOUBLE_EQ(glass->relative_eta(point(), {0, 0, 1}), 1 / eta);
    EXPECT_DOUBLE_EQ(glass->relative_eta(point(), {0, 0, -1}), eta);
  }
  EXPECT_EQ(make_bsdf("plastic")->relative_eta(point(), {0, 0, 1}), 1);
}

/// Snell's law holds between a sample and its source.
TEST(BsdfValues, RefractionObeysSnell) {
  const BsdfPtr glass = make_bsdf("dielectric");
  Rng rng(4, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random_direction(rng);
    const auto s = glass->sample(point(), a, {1 - 1e-9, 0.5, 0.5});
    if (!s || s->lobe != Lobe::transmission) continue;
    const double eta = glass->relative_eta(point(), a);
    EXPECT_NEAR(s->to.x, -eta * a.x, 1e-12);
    EXPECT_NEAR(s->to.y, -eta * a.y, 1e-12);
    EXPECT_LT(s->to.z * a.z, 0);
    EXPECT_NEAR(length(s->to), 1, 1e-12);
  }
}

/// The share of a beam from wl that is scattered, channel by channel: a t-test on the estimate.
TEST(BsdfValues, NoMoreLightLeavesThanArrives) {
  for (const Case& c : cases()) {
    if (!c.conserves_energy) continue;
    for (const Vec3& wl : incident_directions(c)) {
      Moments scattered[3];
      Rng rng(5, Purpose::test, 0);
      for (int i = 0; i < 20000; ++i) {
        const auto s = c.bsdf->sample(point(), wl, random_u(rng));
        const Spectrum w = s ? weight_from_light(*c.bsdf, wl, *s) : Spectrum(0);
        for (int k = 0; k < 3; ++k) scattered[k].add(w[k]);
      }
      for (const Moments& m : scattered) {
        const double error = std::sqrt(m.variance() / static_cast<double>(m.count()));
        const double passes = min_component(c.bsdf->passage(point(), wl).transmittance);
        EXPECT_LE(passes + m.mean(), 1 + 5 * error + 1e-12) << c.label << ", cos " << wl.z;
        EXPECT_GT(passes + m.mean(), 0) << c.label << ", cos " << wl.z;
      }
    }
  }
}

TEST(BsdfValues, AsMuchLightGoesThroughFromBothSides) {
  int passed = 0;
  for (const Case& c : cases()) {
    Rng rng(9, Purpose::test, 0);
    for (int i = 0; i < 1000; ++i) {
      const Vec3 w = random_direction(rng);
      const Passage forth = c.bsdf->passage(point(), w), back = c.bsdf->passage(point(), -w);
      EXPECT_NEAR(forth.probability, back.probability, 1e-12) << c.label;
      EXPECT_LT(max_component(glm::abs((forth.transmittance - back.transmittance).rgb())), 1e-12)
          << c.label;
      EXPECT_TRUE(forth.probability >= 0 && forth.probability <= 1) << c.label;
      EXPECT_TRUE(c.bsdf->has_passage() || forth.is_blocked()) << c.label;
      passed += !forth.is_blocked();
    }
  }
  EXPECT_GE(passed, 5000);
}

TEST(BsdfValues, LosslessDielectricLosesNothing) {
  const Case& glass = find_case("dielectric");
  for (const Vec3& wl : incident_directions(glass)) {
    Spectrum sum(0);
    const Vec3 mirrored = reflect(wl);
    sum += glass.bsdf->eval(point(), wl, mirrored, Lobe::reflection);
    const auto through = glass.bsdf->sample(point(), wl, {1 - 1e-12, 0.5, 0.5});
    if (through->lobe == Lobe::transmission)
      sum += glass.bsdf->eval(point(), wl, through->to, Lobe::transmission);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k], 1, 1e-12);
  }
}

/// A rough interface without absorption loses only what is masked after one scattering: with narrow
/// lobes, next to nothing.
TEST(BsdfValues, AlmostSmoothDielectricLosesAlmostNothing) {
  for (const char* type : {"beckmann", "ggx"}) {
    const BsdfPtr glass =
        make_bsdf("roughdielectric", {{"alpha", 0.001}, {"distribution", std::string(type)}});
    for (const Vec3& wl : {normalize(Vec3(0.3, 0, 1)), normalize(Vec3(0.2, 0.1, -1))}) {
      Moments scattered;
      Rng rng(6, Purpose::test, 0);
      for (int i = 0; i < 5000; ++i) {
        const auto s = glass->sample(point(), wl, random_u(rng));
        scattered.add(s ? weight_from_light(*glass, wl, *s)[0] : 0);
      }
      EXPECT_NEAR(scattered.mean(), 1, 1e-4) << type;
    }
  }
}

TEST(BsdfValues, SamplingWeightsAreBounded) {
  for (const Case& c : cases()) {
    double worst = 0;
    Rng rng(7, Purpose::test, 0);
    for (int i = 0; i < 20000; ++i) {
      const Vec3 wl = random_direction(rng);
      const auto s = c.bsdf->sample(point(), wl, random_u(rng));
      const Passage passage = c.bsdf->passage(point(), wl);
      if (s && passage.probability < 1)
        worst = std::max(
            worst, max_component(weight_from_light(*c.bsdf, wl, *s)) / (1 - passage.probability));
      if (!passage.is_blocked())
        worst = std::max(worst, max_component(passage.transmittance) / passage.probability);
    }
    EXPECT_LE(worst, c.max_weight + 1e-9) << c.label;
    EXPECT_TRUE(std::isfinite(worst)) << c.label;
  }
}

/// Directions and random numbers that break careless code.
struct Nasty {
  Rng rng{8, Purpose::test, 0};

  Vec3 direction() {
    Vec3 w = random_direction(rng);
    switch (rng.below(8)) {
      case 0: return {0, 0, w.z < 0 ? -1.0 : 1.0};
      case 1: return {w.x < 0 ? -1.0 : 1.0, 0, 0};
      case 2: w.z *= std::pow(10.0, -20 * rng.next()); return normalize(w);
      case 3: w.x *= 1e-9, w.y *= 1e-9; return normalize(w);
      default: return w;
    }
  }
  double number() {
    switch (rng.below(8)) {
      case 0: return 0;
      case 1: return 1 - 0x1p-53;
      case 2: return 0.5;
      default: return rng.next();
    }
  }
  Vec3 u() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
};

void expect_sound(const Bsdf& bsdf, const Vec3& wl, const Vec3& wc, Lobe lobe,
                  const std::string& label) {
  const Scattering s = bsdf.scattering(point(), wl, wc, lobe);
  const double smallest = std::min({min_component(s.f), s.pdf_from_light, s.pdf_from_camera});
  ASSERT_TRUE(is_finite(s.f.rgb()) && std::isfinite(s.pdf_from_light + s.pdf_from_camera) &&
              smallest >= 0)
      << label << ": f " << s.f[0] << " densities " << s.pdf_from_light << " " << s.pdf_from_camera
      << " for wl " << wl.x << " " << wl.y << " " << wl.z << ", wc " << wc.x << " " << wc.y << " "
      << wc.z;
}

TEST(BsdfValues, AreFiniteAndNotNegative) {
  const int rounds = 1000000 / static_cast<int>(cases().size()) / 2;
  Nasty nasty;
  for (const Case& c : cases())
    for (int i = 0; i < rounds; ++i) {
      const Vec3 wl = nasty.direction(), wc = nasty.direction();
      expect_sound(*c.bsdf, wl, wc, i % 8 ? Lobe::smooth : lobes[i / 8 % 4], c.label);
      if (HasFatalFailure()) return;
      const auto s = c.bsdf->sample(point(), wl, nasty.u());
      if (!s) continue;
      ASSERT_NEAR(length(s->to), 1, 1e-9) << c.label;
      expect_sound(*c.bsdf, wl, s->to, s->lobe, c.label);
      if (HasFatalFailure()) return;
      const auto u = c.bsdf->invert(point(), wl, s->to, s->lobe, Vec3(0.5));
      if (!u) continue;
      ASSERT_TRUE(min_component(*u) >= 0 && max_component(*u) < 1) << c.label;
    }
}

TEST(BsdfValues, OfLambertianSurfacesAreThoseOfThePlugIn) {
  const BsdfPtr pink = make_bsdf("diffuse", {{"reflectance", Triple{0.9, 0.5, 0.3}}});
  const BsdfPtr gray = make_bsdf("diffuse", {{"reflectance", 0.4}});
  Rng rng(8, Purpose::test, 0);
  const BsdfPtr ramp = make_bsdf("diffuse", {{"reflectance", ramp_texture(0.1, 0.9)}});
  for (const BsdfPtr& bsdf :
       {pink, gray, ramp, make_bsdf("twosided", {}, {pink}), make_bsdf("twosided", {}, {ramp})}) {
    const Lambertian lambertian = bsdf->lambertian(point());
    ASSERT_TRUE(lambertian.known()) << bsdf->type;
    EXPECT_TRUE(bsdf->lambertian().known());
    for (int i = 0; i < 1000; ++i) {
      const Vec3 wl = random_direction(rng), wc = random_direction(rng), u = random_u(rng);
      for (const Lobe lobe : lobes) {
        const Scattering a = lambertian.scattering(wl.z, wc.z, lobe),
                         b = bsdf->scattering(point(), wl, wc, lobe);
        EXPECT_EQ(a.f, b.f);
        EXPECT_EQ(a.pdf_from_light, b.pdf_from_light);
        EXPECT_EQ(a.pdf_from_camera, b.pdf_from_camera);
      }
      const auto a = lambertian.sample(wl.z, {u.y, u.z});
      const auto b = bsdf->sample(point(), wl, u);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (a) {
        EXPECT_EQ(*a, b->to);
      }
    }
  }
}

TEST(BsdfValues, ThatDependOnMoreThanTheCosinesAreNoLambertianSurface) {
  const BsdfPtr gray = make_bsdf("diffuse"), phong = make_bsdf("phong");
  const BsdfPtr pink = make_bsdf("diffuse", {{"reflectance", Triple{0.9, 0.5, 0.3}}});
  EXPECT_FALSE(phong->lambertian(point()).known());
  EXPECT_FALSE(make_bsdf("twosided", {}, {phong})->lambertian(point()).known());
  EXPECT_FALSE(make_bsdf("twosided", {}, {gray, phong})->lambertian(point()).known());
  EXPECT_FALSE(make_bsdf("twosided", {}, {gray, phong})->lambertian().known());
  EXPECT_FALSE(make_bsdf("twosided", {}, {gray, pink})->lambertian().known());
}

/// Glass whose index, and what it lets pass, depend on the wavelength.
struct DispersiveGlass {
  BsdfPtr bsdf = make_bsdf("dielectric", {{"specular_transmittance", colour},
                                          {"int_ior", std::string("cauchy 1.5 9000")},
                                          {"ext_ior", 1.0}});
  Vec3 from = normalize(Vec3(0.3, 0.2, 0.9));

  static inline const WavelengthTable colour{{360, 0.1}, {830, 0.9}};
  double transmittance(double nm) const { return 0.1 + 0.8 * (nm - 360) / 470; }
  double reflectance(double nm) const {
    return fresnel_dielectric(from.z, 1.5 + 9000 / (nm * nm)).reflectance;
  }
  /// Light of the wavelengths of u that is scattered by this lobe, which the number chooses.
  Scattering scattered(double u, Lobe lobe, double choice) const {
    SurfacePoint at = point();
    at.wavelength = u;
    const auto sample = bsdf->sample(at, from, {choice, 0.5, 0.5});
    EXPECT_TRUE(sample && sample->lobe == lobe);
    return bsdf->scattering(at, from, sample->to, lobe);
  }
};

TEST(BsdfValues, DispersiveRefractionsKeepTheFirstWavelength) {
  const DispersiveGlass glass;
  for (const double u : {0.1, 0.4, 0.8}) {
    const double nm = wavelength_of(u);
    const Scattering refracted = glass.scattered(u, Lobe::transmission, 0.999);
    EXPECT_TRUE(refracted.disperses);
    EXPECT_NEAR(refracted.f[0], (1 - glass.reflectance(nm)) * glass.transmittance(nm), 1e-9) << nm;
    for (int j = 1; j < Spectrum::lanes; ++j) EXPECT_EQ(refracted.f[j], 0);
  }
}

TEST(BsdfValues, DispersiveGlassReflectsEachWavelengthByItsOwnIndex) {
  const DispersiveGlass glass;
  for (const double u : {0.1, 0.4, 0.8}) {
    const Scattering reflected = glass.scattered(u, Lobe::reflection, 0);
    EXPECT_FALSE(reflected.disperses);
    const Spectrum expected = at_wavelengths(u, [&](double nm) { return glass.reflectance(nm); });
    for (int j = 0; j < Spectrum::lanes; ++j) EXPECT_NEAR(reflected.f[j], expected[j], 1e-12);
  }
}

TEST(BsdfValues, OneSidedMaterialsAreBlackFromBelow) {
  for (const Case& c : cases()) {
    if (c.two_sided) continue;
    Rng rng(9, Purpose::test, 0);
    for (int i = 0; i < 200; ++i) {
      Vec3 below = random_direction(rng);
      below.z = -std::abs(below.z);
      EXPECT_FALSE(c.bsdf->sample(point(), below, random_u(rng))) << c.label;
      const Vec3 other = random_direction(rng);
      for (Lobe lobe : lobes) {
        EXPECT_TRUE(is_black(c.bsdf->eval(point(), below, other, lobe))) << c.label;
        EXPECT_TRUE(is_black(c.bsdf->eval(point(), other, below, lobe))) << c.label;
        EXPECT_EQ(c.bsdf->pdf(point(), below, other, lobe), 0) << c.label;
      }
    }
  }
}

}  // namespace
}  // namespace mlt::test
