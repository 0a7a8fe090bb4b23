// The chi-square harness must accept right samplers, however narrow, and reject slightly wrong
// ones.
#include "harness/chi_square.h"

#include "math/warp.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

constexpr size_t n_samples = 100000;

Vec2 uniform2(Rng& rng) {
  const double x = rng.next();
  return {x, rng.next()};
}

std::optional<Vec3> cosine_sample(Rng& rng) { return sample_cosine_hemisphere(uniform2(rng)); }

TEST(ChiSquare, AcceptsTheRightDensity) {
  const ChiSquareResult r = chi_square_sphere(cosine_sample, cosine_hemisphere_pdf, n_samples, 1);
  EXPECT_GT(r.p_value, 1e-3) << r;
  EXPECT_NEAR(r.integral, 1, 1e-6) << r;
  EXPECT_GT(r.dof, 200) << r;
}

TEST(ChiSquare, PValuesAreUniform) {
  // 200 independent tests of a right sampler: Kolmogorov-Smirnov distance of their p-values.
  std::vector<double> p;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    ChiSquareOptions options;
    options.cells = 64;
    options.pilot_samples = 2000;
    p.push_back(
        chi_square_sphere(cosine_sample, cosine_hemisphere_pdf, 5000, seed, options).p_value);
  }
  std::sort(p.begin(), p.end());
  double distance = 0;
  const double n = static_cast<double>(p.size());
  for (size_t i = 0; i < p.size(); ++i)
    distance =
        std::max({distance, std::abs(p[i] - double(i) / n), std::abs(p[i] - double(i + 1) / n)});
  EXPECT_LT(distance, 1.95 / std::sqrt(n));  // the 1e-3 quantile of Kolmogorov's distribution
}

TEST(ChiSquare, RejectsAnotherDensity) {
  const auto uniform = [](const Vec3& w) { return cone_pdf(w, 1); };
  EXPECT_LT(chi_square_sphere(cosine_sample, uniform, n_samples, 1).p_value, 1e-9);
}

TEST(ChiSquare, RejectsFivePerCentOfModulation) {
  const auto wrong = [](const Vec3& w) {
    return cosine_hemisphere_pdf(w) * (1 + 0.05 * w.x / std::sqrt(std::max(1e-9, sin2_theta(w))));
  };
  EXPECT_LT(chi_square_sphere(cosine_sample, wrong, 4 * n_samples, 1).p_value, 1e-6);
}

TEST(ChiSquare, RejectsTwoPerCentOfScale) {
  const auto wrong = [](const Vec3& w) { return 1.02 * cosine_hemisphere_pdf(w); };
  const ChiSquareResult r = chi_square_sphere(cosine_sample, wrong, n_samples, 1);
  EXPECT_EQ(r.p_value, 0) << r;
  EXPECT_NEAR(r.integral, 1.02, 1e-4) << r;
}

TEST(ChiSquare, ResolvesNarrowLobes) {
  for (double n : {10.0, 1e3, 1e6, 1e9}) {
    const Vec3 axis = normalize(Vec3(0.3, -0.5, 0.4));
    const auto sample = [&](Rng& rng) -> std::optional<Vec3> {
      return sample_lobe(uniform2(rng), axis, n);
    };
    const ChiSquareResult right = chi_square_sphere(
        sample, [&](const Vec3& w) { return lobe_pdf(w, axis, n); }, n_samples, 2);
    EXPECT_GT(right.p_value, 1e-3) << "n = " << n << ": " << right;
    EXPECT_NEAR(right.integral, 1, 1e-3) << right;
    const ChiSquareResult wrong = chi_square_sphere(
        sample, [&](const Vec3& w) { return lobe_pdf(w, axis, 1.05 * n); }, n_samples, 2);
    EXPECT_LT(wrong.p_value, 1e-6) << "n = " << n << ": " << wrong;
  }
}

TEST(ChiSquare, CountsFailures) {
  const auto sometimes = [](Rng& rng) -> std::optional<Vec3> {
    if (rng.next() < 0.25) return std::nullopt;
    return cosine_sample(rng);
  };
  const auto three_quarters = [](const Vec3& w) { return 0.75 * cosine_hemisphere_pdf(w); };
  const ChiSquareResult right = chi_square_sphere(sometimes, three_quarters, n_samples, 3);
  EXPECT_GT(right.p_value, 1e-3) << right;
  EXPECT_NEAR(right.failure_rate, 0.25, 0.01);
  EXPECT_LT(chi_square_sphere(sometimes, cosine_hemisphere_pdf, n_samples, 3).p_value, 1e-9);
}

TEST(ChiSquare, ReportsBrokenSamplers) {
  const auto nan = [](Rng&) -> std::optional<Vec3> { return Vec3(std::nan("")); };
  EXPECT_NE(chi_square_sphere(nan, cosine_hemisphere_pdf, 1000, 1).problem, "");
  const auto negative = [](const Vec3&) { return -1.0; };
  EXPECT_NE(chi_square_sphere(cosine_sample, negative, 1000, 1).problem, "");
}

TEST(ChiSquare, PoolsSmallCells) {
  const ChiSquareResult r = chi_square_counts({1, 0, 2, 3, 10, 20}, {1, 1, 1.5, 2, 10, 20.5}, 5);
  EXPECT_EQ(r.dof, 2);  // {1, 1, 1.5, 2} -> 5.5, 10, 20.5
  EXPECT_NEAR(r.statistic, 0.25 / 5.5 + 0.25 / 20.5, 1e-12);
}

}  // namespace
}  // namespace mlt::test
