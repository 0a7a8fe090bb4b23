#include "math/distribution.h"

#include "base/error.h"
#include "harness/chi_square.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

Vec2 uniform2(Rng& rng) {
  const double x = rng.next();
  return {x, rng.next()};
}

TEST(Discrete, SamplesInProportionToItsWeights) {
  const std::vector<double> weights{0, 3, 0, 1, 1e-3, 5, 0};
  const Discrete d(weights);
  Rng rng(1, Purpose::test, 0);
  constexpr int n = 200000;
  std::vector<double> observed(weights.size(), 0.0), expected;
  Moments remainders;
  for (int i = 0; i < n; ++i) {
    const Discrete::Sample s = d.sample_reuse(rng.next());
    observed[s.index] += 1;
    remainders.add(s.remainder);
  }
  double sum = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    EXPECT_NEAR(d.pdf(i), weights[i] / d.total(), 1e-15);
    expected.push_back(n * d.pdf(i));
    sum += d.pdf(i);
    if (weights[i] == 0) {
      EXPECT_EQ(observed[i], 0);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-15);
  const ChiSquareResult r = chi_square_counts(observed, expected);
  EXPECT_GT(r.p_value, 1e-3) << r;
  EXPECT_GT(one_sample_t_test(remainders, 0.5).p_value, 1e-3);
}

TEST(Discrete, InvertsAndNeverPicksZeroWeights) {
  const Discrete d(std::vector<double>{0, 2, 0, 0, 1, 0});
  for (double u : {0.0, 1e-17, 0.3, 2.0 / 3, 0.7, 1 - 0x1p-53}) {
    const Discrete::Sample s = d.sample_reuse(u);
    EXPECT_TRUE(s.index == 1 || s.index == 4) << u;
    EXPECT_EQ(d.sample(u), s.index);
    EXPECT_LT(s.remainder, 1);
    EXPECT_NEAR(d.invert(s.index, s.remainder), u, 1e-15);
  }
  EXPECT_EQ(Discrete(std::vector<double>{7}).sample(0.5), 0u);
}

TEST(Discrete, RefusesBadWeights) {
  EXPECT_THROW(Discrete(std::vector<double>{}), UsageError);
  EXPECT_THROW(Discrete(std::vector<double>{0, 0}), UsageError);
  EXPECT_THROW(Discrete(std::vector<double>{1, -1}), UsageError);
  EXPECT_THROW(Discrete(std::vector<double>{1, std::nan("")}), UsageError);
  EXPECT_THROW(Discrete(std::vector<double>{1, infinity}), UsageError);
  EXPECT_THROW(Discrete(std::vector<double>{1e308, 1e308}), UsageError);
}

/// A sun on a gradient, with a black row, black columns and a speck of light.
std::vector<float> environment(size_t width, size_t height) {
  std::vector<float> f(width * height);
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x)
      f[y * width + x] =
          (x < 2 || y == 3 || x + 1 == width) ? 0.f : 0.1f + float(y) / float(height);
  f[5 * width + 7] = 500;
  f[4 * width + 9] = 1e-9f;
  return f;
}

TEST(Piecewise2D, SamplesFollowItsDensity) {
  for (const auto& [width, height] : {std::pair<size_t, size_t>{32, 16}, {13, 11}}) {
    const Piecewise2D d(environment(width, height), width, height);
    ChiSquareOptions options;
    for (size_t i = 1; i < width; ++i) options.x_breaks.push_back(double(i) / double(width));
    for (size_t i = 1; i < height; ++i) options.y_breaks.push_back(double(i) / double(height));
    const ChiSquareResult r = chi_square_rect(
        [&](Rng& rng) -> std::optional<Vec2> { return d.sample(uniform2(rng)).at; },
        [&](const Vec2& p) { return d.pdf(p); }, {0, 0}, {1, 1}, 200000, 5, options);
    EXPECT_GT(r.p_value, 1e-3) << r;
    EXPECT_NEAR(r.integral, 1, 1e-9) << r;
  }
}

TEST(Piecewise2D, DensityIsTheTable) {
  const size_t width = 32, height = 16;
  const std::vector<float> f = environment(width, height);
  const Piecewise2D d(f, width, height);
  for (size_t y = 0; y < height; ++y)
    for (size_t x = 0; x < width; ++x) {
      const double w = f[y * width + x];
      const double p = d.pdf({(double(x) + 0.5) / width, (double(y) + 0.5) / height});
      EXPECT_EQ(p > 0, w > 0) << x << ", " << y;
      // One unit of the row's table, 2^-32 of the row, is the resolution.
      EXPECT_NEAR(p, w / d.integral(), width * 0x1p-31 * 500 / d.integral()) << x << ", " << y;
    }
}

TEST(Piecewise2D, Inverts) {
  const Piecewise2D d(environment(64, 32), 64, 32);
  Rng rng(3, Purpose::test, 0);
  for (int i = 0; i < 100000; ++i) {
    const Vec2 u = uniform2(rng), p = d.sample(u).at;
    ASSERT_GT(d.pdf(p), 0);
    const Vec2 v = d.invert(p);
    ASSERT_NEAR(v.x, u.x, 1e-9);
    ASSERT_NEAR(v.y, u.y, 1e-9);
  }
}

TEST(Piecewise2D, SamplesManyTogetherAsAlone) {
  for (const size_t width : {3, 40, 700}) {
    const Piecewise2D d(environment(width, 60), width, 60);
    Rng rng(4, Purpose::test, width);
    for (int round = 0; round < 100; ++round) {
      const int count = static_cast<int>(rng.below(Piecewise2D::most_together + 1));
      Vec2 u[Piecewise2D::most_together];
      Piecewise2D::Cells together;
      for (int i = 0; i < count; ++i) u[i] = uniform2(rng);
      d.sample_cells(u, count, together);
      for (int i = 0; i < count; ++i) {
        const Piecewise2D::Sample alone = d.sample(u[i]);
        const Vec2 cell(together.column[i], together.row[i]);
        const Vec2 at = (cell + Vec2(together.x[i], together.y[i])) / Vec2(width, 60);
        ASSERT_EQ(at, alone.at);
        ASSERT_EQ(together.probability[i] * double(width * 60), alone.pdf);
        ASSERT_EQ(alone.pdf, d.pdf(alone.at));
      }
    }
  }
}

TEST(Piecewise2D, HandlesOneCellAndTheEdges) {
  const Piecewise2D one({2.f}, 1, 1);
  EXPECT_EQ(one.integral(), 2);
  EXPECT_EQ(one.pdf({1, 1}), 1);
  EXPECT_EQ(one.pdf({0, 0}), 1);
  const Piecewise2D last({0, 0, 0, 1}, 2, 2);
  EXPECT_EQ(last.pdf(last.sample({0, 0}).at), 4);
  EXPECT_EQ(last.pdf(last.sample({1 - 0x1p-53, 1 - 0x1p-53}).at), 4);
  EXPECT_EQ(last.pdf({1, 1}), 4);
}

TEST(Piecewise2D, RefusesBadTables) {
  EXPECT_THROW(Piecewise2D({1, 2, 3}, 2, 2), UsageError);
  EXPECT_THROW(Piecewise2D({}, 0, 0), UsageError);
  EXPECT_THROW(Piecewise2D({0, 0}, 2, 1), UsageError);
  EXPECT_THROW(Piecewise2D({1, -1}, 2, 1), UsageError);
  EXPECT_THROW(Piecewise2D({1, std::nanf("")}, 2, 1), UsageError);
}

}  // namespace
}  // namespace mlt::test
