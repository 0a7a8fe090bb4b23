// Phase functions as triples: what is drawn follows the density, which integrates to 1 over the
// sphere, and the inverse gives the numbers back.
#include "harness/chi_square.h"
#include "scene/bsdf/bsdf_testing.h"
#include "scene/bsdf/scattering_lanes.h"

#include <gtest/gtest.h>

namespace mlt {

#define MLT_PLUGIN(family, name) Plugin family##_##name();
#include "scene/phase/list.inc"
#undef MLT_PLUGIN

namespace test {
namespace {

struct Phase {
  std::string label;
  BsdfPtr phase;
  double mean_cosine;  ///< Of the deflection.
};

BsdfPtr make(const Plugin& plugin, const Given& given = {},
             const std::vector<BsdfPtr>& nested = {}) {
  const Location where{"test.xml", 7};
  Params params(plugin.schema, where);
  for (const auto& [key, value] : given) params.set(key, value, where);
  for (const BsdfPtr& part : nested)
    params.add("phase", std::const_pointer_cast<Bsdf>(part), where);
  BsdfPtr made = std::dynamic_pointer_cast<const Bsdf>(plugin.create(params));
  params.expect_all_read();
  return made;
}

std::vector<Phase> phases() {
  std::vector<Phase> all{{"isotropic", make(phase_isotropic()), 0},
                         {"rayleigh", make(phase_rayleigh()), 0}};
  for (const double g : {-0.99, -0.5, -1e-9, 0.0, 1e-5, 0.3, 0.8, 0.99})
    all.push_back({fmt::format("hg {}", g), make(phase_hg(), {{"g", g}}), g});
  all.push_back({"blend",
                 make(phase_blendphase(), {{"weight", 0.25}},
                      {make(phase_hg(), {{"g", 0.6}}), make(phase_rayleigh())}),
                 0.75 * 0.6});
  return all;
}

const SurfacePoint at = point();

TEST(PhaseFunction, FollowsItsDensity) {
  std::vector<double> p_values;
  std::vector<std::string> messages;
  Rng rng(1, Purpose::test, 0);
  for (const Phase& p : phases()) {
    const Vec3 from = random_direction(rng);
    ChiSquareOptions options;
    options.cells = 200;
    options.pilot_samples = 4000;
    const ChiSquareResult r = chi_square_sphere(
        [&](Rng& u) { return std::optional(p.phase->sample(at, from, random_u(u))->to); },
        [&](const Vec3& to) { return p.phase->pdf(at, from, to, Lobe::smooth); }, 50000, 3,
        options);
    EXPECT_NEAR(r.integral, 1, 1e-3) << p.label;
    p_values.push_back(r.p_value);
    messages.push_back(p.label);
  }
  const std::vector<bool> rejected = holm(p_values, 1e-3);
  for (size_t i = 0; i < rejected.size(); ++i) EXPECT_FALSE(rejected[i]) << messages[i];
}

TEST(PhaseFunction, HasItsMeanCosine) {
  Rng rng(2, Purpose::test, 0);
  for (const Phase& p : phases()) {
    const Vec3 from = random_direction(rng);
    double sum = 0, squares = 0;
    constexpr int n = 100000;
    for (int i = 0; i < n; ++i) {
      const double cosine = -dot(from, p.phase->sample(at, from, random_u(rng))->to);
      sum += cosine / n;
      squares += cosine * cosine / n;
    }
    EXPECT_NEAR(sum, p.mean_cosine, 5 * std::sqrt((squares - sum * sum) / n)) << p.label;
  }
}

TEST(PhaseFunction, GivesTheNumbersBackAndIsReciprocal) {
  Rng rng(3, Purpose::test, 0);
  for (const Phase& p : phases())
    for (int i = 0; i < 1000; ++i) {
      const Vec3 from = random_direction(rng), u = random_u(rng);
      const Vec3 to = p.phase->sample(at, from, u)->to;
      ASSERT_NEAR(length(to), 1, 1e-12) << p.label;
      const auto v = p.phase->invert(at, from, to, Lobe::smooth, random_u(rng));
      ASSERT_TRUE(v) << p.label;
      ASSERT_LT(length(p.phase->sample(at, from, *v)->to - to), 1e-7) << p.label;
      if (p.label != "blend") {
        ASSERT_NEAR(v->y, u.y, 1e-6) << p.label;
      }
      const Scattering s = p.phase->scattering(at, from, to, Lobe::smooth);
      ASSERT_EQ(s.pdf_from_light, s.pdf_from_camera) << p.label;
      ASSERT_NEAR(s.f[0], s.pdf_from_light, 1e-12 * s.f[0]) << p.label;
      ASSERT_EQ(p.phase->eval(at, to, from, Lobe::smooth), s.f) << p.label;
    }
}

TEST(PhaseFunction, ScattersLightInLanesAsAtSinglePoints) {
  constexpr int points = 61;  // not a multiple of eight
  int supported = 0;
  Rng rng(4, Purpose::test, 0);
  for (const Phase& p : phases()) {
    if (!p.phase->supports_lanes()) continue;
    ++supported;
    ScatteringLanes x;
    std::vector<Vec3> wc, wl, u;
    x.count = points;
    for (int i = 0; i < points; ++i) {
      wc.push_back(random_direction(rng));
      wl.push_back(i % 5 == 0 ? Vec3(0) : random_direction(rng));
      u.push_back(random_u(rng));
      x.at[i] = &at;
      x.wc.set(i, Vec3f(wc[i]));
      x.wl.set(i, Vec3f(wl[i]));
      x.set_numbers(i, u[i]);
    }
    p.phase->scatter(x);
    for (int i = 0; i < points; ++i) {
      const double light = i % 5 == 0 ? 0 : p.phase->pdf(at, wc[i], wl[i], Lobe::smooth);
      ASSERT_NEAR(x.pdf_light[i], light, 1e-4 * light) << p.label;
      ASSERT_EQ(x.f_light[i], Spectrum(double{x.pdf_light[i]})) << p.label;
      ASSERT_LT(length(Vec3(x.to[i]) - p.phase->sample(at, wc[i], u[i])->to), 1e-3) << p.label;
      const double next = p.phase->pdf(at, wc[i], normalize(Vec3(x.to[i])), Lobe::smooth);
      ASSERT_NEAR(x.pdf[i], next, 1e-3 * next) << p.label;
      ASSERT_EQ(x.f[i], Spectrum(double{x.pdf[i]})) << p.label;
    }
  }
  EXPECT_EQ(supported, 7);  // isotropic, and those of hg but for +-0.99
}

}  // namespace
}  // namespace test
}  // namespace mlt
