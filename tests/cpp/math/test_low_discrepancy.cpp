// Scrambled Sobol' points are a (0, 2)-sequence in base 2, whatever the seed; each is uniform by
// itself, and those of different seeds have nothing to do with each other.
#include "math/low_discrepancy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "harness/chi_square.h"

namespace mlt {
namespace {

using namespace test;

constexpr double alpha = 1e-5;
using Sequence = std::function<Vec2(uint32_t index)>;

/// Does each elementary interval 2^-a x 2^-(m - a) hold exactly one of the 2^m points of the block?
bool is_stratified(const Sequence& sequence, uint32_t block, int m) {
  const uint32_t count = 1u << m;
  std::vector<Vec2> points;
  for (uint32_t i = 0; i < count; ++i) points.push_back(sequence(block * count + i));
  for (int a = 0; a <= m; ++a) {
    std::vector<bool> taken(count);
    for (const Vec2& p : points) {
      const auto x = static_cast<uint32_t>(std::ldexp(p.x, a));
      const auto y = static_cast<uint32_t>(std::ldexp(p.y, m - a));
      const uint32_t cell = (x << (m - a)) | y;
      if (taken[cell]) return false;
      taken[cell] = true;
    }
  }
  return true;
}

TEST(ScrambledSobol, EveryBlockIsStratifiedInAllElementaryIntervals) {
  for (uint64_t seed = 0; seed < 20; ++seed)
    for (int m = 0; m <= 12; ++m) {
      const uint32_t last = static_cast<uint32_t>((uint64_t{1} << (32 - m)) - 1);
      for (const uint32_t block : {0u, 1u, 5u, last / 3, last})
        ASSERT_TRUE(is_stratified([&](uint32_t i) { return scrambled_sobol(i, seed); }, block, m))
            << "seed " << seed << ", block " << block << " of 2^" << m;
    }
}

TEST(ScrambledSobol, TheCheckFindsBlocksThatAreNot) {
  Rng rng(1, Purpose::test, 0);
  EXPECT_FALSE(is_stratified([&](uint32_t) { return Vec2(rng.next(), rng.next()); }, 0, 6));
  // Stratified in each dimension, and not in both together.
  EXPECT_FALSE(is_stratified(
      [](uint32_t i) { return Vec2(reverse_bits(i), reverse_bits(i ^ (i >> 1))) * 0x1p-32; }, 0,
      6));
}

TEST(ScrambledSobol, LiesInTheUnitSquare) {
  Rng rng(2, Purpose::test, 0);
  for (int i = 0; i < 1'000'000; ++i) {
    const Vec2 p = scrambled_sobol(static_cast<uint32_t>(rng.next_bits()), rng.next_bits());
    ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
  }
}

TEST(ScrambledRadicalInverse, IsTheFirstCoordinate) {
  Rng rng(7, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const auto index = static_cast<uint32_t>(rng.next_bits());
    const uint64_t seed = rng.next_bits();
    ASSERT_EQ(scrambled_radical_inverse(index, seed), scrambled_sobol(index, seed).x);
  }
}

TEST(ReverseBits, IsAnInvolution) {
  EXPECT_EQ(reverse_bits(1), 0x80000000u);
  EXPECT_EQ(reverse_bits(0x0000000du), 0xb0000000u);
  Rng rng(3, Purpose::test, 0);
  for (int i = 0; i < 1000; ++i) {
    const auto x = static_cast<uint32_t>(rng.next_bits());
    EXPECT_EQ(reverse_bits(reverse_bits(x)), x);
    for (int bit = 0; bit < 32; ++bit) ASSERT_EQ(x >> bit & 1, reverse_bits(x) >> (31 - bit) & 1);
  }
}

TEST(Sobol, TheSecondDimensionIsPascalsMatrix) {
  // y_i = sum over j of binomial(j, i) x_j modulo 2; odd exactly if i is a subset of j (Lucas).
  Rng rng(4, Purpose::test, 0);
  for (int n = 0; n < 1000; ++n) {
    const auto index = static_cast<uint32_t>(rng.next_bits());
    uint32_t expected = 0;
    for (uint32_t i = 0; i < 32; ++i)
      for (uint32_t j = i; j < 32; ++j)
        if ((i & j) == i) expected ^= (index >> j & 1) << i;
    ASSERT_EQ(sobol_1_reversed(index), expected);
  }
}

// ---- over seeds

/// Chi-square of n pairs in [0, 1)^2 against uniformity on a grid.
double grid_p_value(int n, const std::function<Vec2(uint64_t)>& pair) {
  constexpr int cells = 32;
  std::vector<double> observed(cells * cells), expected(cells * cells, n / double(cells * cells));
  for (int i = 0; i < n; ++i) {
    const Vec2 p = pair(static_cast<uint64_t>(i));
    observed[static_cast<int>(p.x * cells) * cells + static_cast<int>(p.y * cells)] += 1;
  }
  return chi_square_counts(observed, expected).p_value;
}

const std::vector<uint32_t> indices{0, 1, 2, 3, 7, 100, 12345, 0x80000000u, 0xffffffffu};

TEST(ScrambledSobol, EachPointIsUniformOverSeeds) {
  std::vector<double> p;
  for (const uint32_t index : indices)
    p.push_back(grid_p_value(100'000, [&](uint64_t seed) { return scrambled_sobol(index, seed); }));
  for (const double adjusted : holm_adjusted(p)) EXPECT_GT(adjusted, alpha);
}

TEST(ScrambledSobol, NeighbouringSeedsAreIndependent) {
  std::vector<double> p;
  for (const uint32_t index : indices) {
    const auto point = [&](uint64_t seed) { return scrambled_sobol(index, seed); };
    p.push_back(
        grid_p_value(100'000, [&](uint64_t s) { return Vec2(point(s).x, point(s + 1).x); }));
    p.push_back(
        grid_p_value(100'000, [&](uint64_t s) { return Vec2(point(s).y, point(s + 1).y); }));
    p.push_back(
        grid_p_value(100'000, [&](uint64_t s) { return Vec2(point(s).x, point(s + 1).y); }));
    p.push_back(
        grid_p_value(100'000, [&](uint64_t s) { return Vec2(point(s).y, point(s + 1).x); }));
  }
  for (const double adjusted : holm_adjusted(p)) EXPECT_GT(adjusted, alpha);
}

/// The correlation, at equal indices, of the first n points of two sequences; over many pairs of
/// sequences its mean is 0. Tested for functions that see more than the mean.
double correlation_p_value(uint32_t n, const std::function<Vec2(uint32_t, uint64_t)>& first,
                           const std::function<Vec2(uint32_t, uint64_t)>& second) {
  const std::vector<std::function<double(double)>> functions{
      [](double u) { return u - 0.5; }, [](double u) { return u < 0.25 ? 0.75 : -0.25; },
      [](double u) { return std::cos(2 * pi * u); }, [](double u) { return std::sin(8 * pi * u); }};
  std::vector<Moments> products(functions.size() * 4);
  for (uint64_t pair = 0; pair < 20'000; ++pair) {
    std::vector<double> sums(products.size());
    for (uint32_t i = 0; i < n; ++i) {
      const Vec2 a = first(i, pair), b = second(i, pair);
      for (size_t f = 0; f < functions.size(); ++f)
        for (int d = 0; d < 4; ++d)
          sums[4 * f + d] += functions[f](a[d & 1]) * functions[f](b[d >> 1]);
    }
    for (size_t k = 0; k < sums.size(); ++k) products[k].add(sums[k] / n);
  }
  std::vector<double> p;
  for (const Moments& m : products) p.push_back(one_sample_t_test(m).p_value);
  const std::vector<double> adjusted = holm_adjusted(p);
  return *std::min_element(adjusted.begin(), adjusted.end());
}

TEST(ScrambledSobol, SequencesOfDifferentSeedsAreUncorrelated) {
  for (const uint32_t n : {2, 16, 64})
    EXPECT_GT(correlation_p_value(
                  n, [](uint32_t i, uint64_t pair) { return scrambled_sobol(i, 2 * pair); },
                  [](uint32_t i, uint64_t pair) { return scrambled_sobol(i, 2 * pair + 1); }),
              alpha)
        << n;
}

TEST(ScrambledSobol, SequencesInTheSameOrderAreFoundCorrelated) {
  // Scrambled by one digit only and not shuffled, the points of two sequences go hand in hand.
  const auto flipped = [](uint32_t i, uint64_t pair) {
    return Vec2(reverse_bits(i ^ static_cast<uint32_t>(pair & 1)),
                reverse_bits(sobol_1_reversed(i))) *
           0x1p-32;
  };
  EXPECT_LT(correlation_p_value(16, flipped,
                                [&](uint32_t i, uint64_t pair) { return flipped(i, pair / 2); }),
            alpha);
}

TEST(ScrambledSobol, IntegratesWithoutBiasAndWithLessNoise) {
  const auto f = [](const Vec2& p) { return p.x * p.x * std::exp(p.y); };
  const double integral = (std::exp(1.0) - 1) / 3;
  Moments sobol, excess;
  Rng rng(5, Purpose::test, 0);
  for (uint64_t seed = 0; seed < 10'000; ++seed) {
    constexpr uint32_t n = 16;
    double stratified = 0, random = 0;
    for (uint32_t i = 0; i < n; ++i) {
      stratified += f(scrambled_sobol(i, seed)) / n;
      random += f({rng.next(), rng.next()}) / n;
    }
    sobol.add(stratified);
    excess.add(sqr(random - integral) - sqr(stratified - integral));
  }
  EXPECT_GT(one_sample_t_test(sobol, integral).p_value, alpha);
  EXPECT_GT(excess.mean(), 0);
  EXPECT_LT(one_sample_t_test(excess).p_value, alpha);
}

}  // namespace
}  // namespace mlt
