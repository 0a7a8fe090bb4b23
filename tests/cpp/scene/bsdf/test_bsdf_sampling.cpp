// Every material as a triple: samples follow the density, the density integrates to at most one,
// and the inverse gives random numbers that lead to the same direction.
#include "harness/chi_square.h"
#include "scene/bsdf/bsdf_testing.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

constexpr size_t n_samples = 50000;
constexpr double level = 1e-3;
/// The harness integrates each of some 250 cells to 0.02 sqrt(5) / n_samples.
constexpr double quadrature_error = 1e-3;

ChiSquareResult chi_square_of_smooth_lobes(const Bsdf& bsdf, const Vec3& from) {
  ChiSquareOptions options;
  options.cells = 200;
  options.pilot_samples = 4000;
  return chi_square_sphere(
      [&](Rng& rng) -> std::optional<Vec3> {
        const auto s = bsdf.sample(point(), from, random_u(rng));
        if (!s || s->lobe != Lobe::smooth) return std::nullopt;
        return s->to;
      },
      [&](const Vec3& to) { return bsdf.pdf(point(), from, to, Lobe::smooth); }, n_samples, 3,
      options);
}

double delta_probability(const Bsdf& bsdf, const Vec3& from) {
  double sum = 0;
  for (int i = 0; i < 64; ++i) {  // each delta lobe is met by one u.x or another
    const auto s = bsdf.sample(point(), from, {(i + 0.5) / 64, 0.5, 0.5});
    if (s && s->lobe != Lobe::smooth) sum = std::max(sum, bsdf.pdf(point(), from, s->to, s->lobe));
  }
  return sum;
}

TEST(BsdfSampling, FollowsTheDensity) {
  std::vector<double> p_values;
  std::vector<std::string> messages;
  for (const Case& c : cases()) {
    if (!c.bsdf->has_smooth()) continue;
    for (const Vec3& from : incident_directions(c)) {
      const ChiSquareResult r = chi_square_of_smooth_lobes(*c.bsdf, from);
      p_values.push_back(r.p_value);
      std::ostringstream message;
      message << c.label << ", cos " << from.z << ": " << r;
      messages.push_back(message.str());
      const double total = r.integral + delta_probability(*c.bsdf, from);
      EXPECT_LE(total, 1 + quadrature_error) << messages.back();
      EXPECT_GE(total, 1 - c.lost_samples - quadrature_error) << messages.back();
    }
  }
  const std::vector<bool> rejected = holm(p_values, level);
  for (size_t i = 0; i < rejected.size(); ++i) EXPECT_FALSE(rejected[i]) << messages[i];
}

TEST(BsdfSampling, DeltaLobesAreDrawnAsOftenAsTheirProbability) {
  std::vector<double> p_values;
  std::vector<std::string> messages;
  for (const Case& c : cases()) {
    if (!c.bsdf->has_delta()) continue;
    for (const Vec3& from : incident_directions(c)) {
      size_t drawn[4] = {};
      double probability[4] = {};
      Rng rng(5, Purpose::test, 0);
      for (size_t i = 0; i < n_samples; ++i) {
        const auto s = c.bsdf->sample(point(), from, random_u(rng));
        if (!s || s->lobe == Lobe::smooth) continue;
        ++drawn[static_cast<size_t>(s->lobe)];
        probability[static_cast<size_t>(s->lobe)] = c.bsdf->pdf(point(), from, s->to, s->lobe);
      }
      for (size_t lobe = 0; lobe < 4; ++lobe) {
        const double p = probability[lobe], n = static_cast<double>(n_samples);
        if (drawn[lobe] == 0) continue;
        messages.push_back(c.label + ", lobe " + std::to_string(lobe));
        if (p > 1 - 1e-12) {
          EXPECT_EQ(drawn[lobe], n_samples) << messages.back();
          p_values.push_back(1);
          continue;
        }
        const double z = (static_cast<double>(drawn[lobe]) - n * p) / std::sqrt(n * p * (1 - p));
        p_values.push_back(2 * normal_cdf(-std::abs(z)));
      }
    }
  }
  const std::vector<bool> rejected = holm(p_values, level);
  for (size_t i = 0; i < rejected.size(); ++i) EXPECT_FALSE(rejected[i]) << messages[i];
}

TEST(BsdfSampling, InverseLeadsToTheSameDirection) {
  for (const Case& c : cases())
    for (const Vec3& from : incident_directions(c)) {
      Rng rng(9, Purpose::test, 0);
      double worst = 0;
      for (int i = 0; i < 2000; ++i) {
        const auto s = c.bsdf->sample(point(), from, random_u(rng));
        if (!s) continue;
        const auto u = c.bsdf->invert(point(), from, s->to, s->lobe, random_u(rng));
        ASSERT_TRUE(u) << c.label;
        ASSERT_GE(min_component(*u), 0) << c.label;
        ASSERT_LT(max_component(*u), 1) << c.label;
        const auto again = c.bsdf->sample(point(), from, *u);
        ASSERT_TRUE(again) << c.label;
        EXPECT_EQ(again->lobe, s->lobe) << c.label;
        worst = std::max(worst, length(again->to - s->to));
      }
      EXPECT_LT(worst, 1e-6) << c.label << ", cos " << from.z;
    }
}

/// Of all numbers that give a direction, the inverse draws one as likely as it has given it: over
/// all directions these numbers are as those that were drawn.
TEST(BsdfSampling, InverseDrawsNumbersAsTheyWere) {
  std::vector<double> p_values;
  std::vector<std::string> messages;
  for (const Case& c : cases())
    for (const Vec3& from : incident_directions(c)) {
      Rng rng(14, Purpose::test, 0);
      std::vector<Moments> differences(12);
      for (int i = 0; i < 20'000; ++i) {
        const Vec3 u = random_u(rng);
        const auto s = c.bsdf->sample(point(), from, u);
        if (!s) continue;
        const auto v = c.bsdf->invert(point(), from, s->to, s->lobe, random_u(rng));
        ASSERT_TRUE(v) << c.label;
        size_t k = 0;
        for (int axis = 0; axis < 3; ++axis)
          for (int frequency = 1; frequency <= 2; ++frequency) {
            const double a = 2 * pi * frequency * (*v)[axis], b = 2 * pi * frequency * u[axis];
            const bool same = std::abs(a - b) < 1e-6;  // but for rounding
            differences[k++].add(same ? 0 : std::cos(a) - std::cos(b));
            differences[k++].add(same ? 0 : std::sin(a) - std::sin(b));
          }
      }
      if (differences[0].count() < 1000) continue;
      p_values.push_back(
          smallest_p_value(differences, std::vector<double>(differences.size(), 0.0)));
      messages.push_back(c.label + ", cos " + std::to_string(from.z));
    }
  const std::vector<bool> rejected = holm(p_values, level);
  for (size_t i = 0; i < rejected.size(); ++i)
    EXPECT_FALSE(rejected[i]) << messages[i] << ", p " << p_values[i];
}

/// Models whose directions come from one map each, so that the random numbers themselves return.
TEST(BsdfSampling, InverseGivesTheRandomNumbersBack) {
  for (const Case& c : cases()) {
    const auto named = [&](const char* part) { return c.label.find(part) != std::string::npos; };
    if (named("roughplastic") || named("phong") || named("blend") || named("mixture") ||
        named("ward") || named("principled") || named("openpbr") || c.label == "twosided" ||
        named("of twosided"))
      continue;
    for (const Vec3& from : incident_directions(c)) {
      Rng rng(13, Purpose::test, 0);
      double worst = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vec3 u = random_u(rng);
        const auto s = c.bsdf->sample(point(), from, u);
        if (!s || s->lobe != Lobe::smooth) continue;
        const Vec3 d =
            glm::abs(c.bsdf->invert(point(), from, s->to, s->lobe, Vec3(0.5)).value() - u);
        worst = std::max({worst, std::min(d.y, 1 - d.y), std::min(d.z, 1 - d.z)});
      }
      EXPECT_LT(worst, 1e-4) << c.label << ", cos " << from.z;
    }
  }
}

TEST(BsdfSampling, AnImpossibleDirectionHasNoInverse) {
  const Vec3 up = normalize(Vec3(0.1, 0.2, 1)), down = normalize(Vec3(0.3, 0, -1));
  EXPECT_FALSE(make_bsdf("diffuse")->invert(point(), up, down, Lobe::smooth, Vec3(0.5)));
  EXPECT_FALSE(make_bsdf("diffuse")->invert(point(), up, up, Lobe::reflection, Vec3(0.5)));
  EXPECT_FALSE(make_bsdf("conductor")->invert(point(), up, up, Lobe::smooth, Vec3(0.5)));
  EXPECT_FALSE(make_bsdf("plastic")->invert(point(), down, down, Lobe::smooth, Vec3(0.5)));
  EXPECT_FALSE(make_bsdf("dielectric")->invert(point(), up, up, Lobe::transmission, Vec3(0.5)));
  EXPECT_FALSE(
      make_bsdf("roughdielectric")->invert(point(), up, up, Lobe::transmission, Vec3(0.5)));
  EXPECT_FALSE(make_bsdf("null")->invert(point(), up, up, Lobe::smooth, Vec3(0.5)));
}

}  // namespace
}  // namespace mlt::test
