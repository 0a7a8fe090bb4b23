// The generator agrees with published numbers, is uniform, and its streams are independent.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "base/rng.h"
#include "harness/chi_square.h"

namespace mlt {
namespace {

using test::chi_square_counts;

constexpr double alpha = 1e-5;

TEST(Rng, AgreesWithTheReferenceImplementation) {
  // Outputs of the authors' C code, which other implementations are tested with as well.
  Rng rng(Rng::State{1, 2, 3, 4});
  const uint64_t outputs[] = {41943041u,
                              58720359u,
                              3588806011781223u,
                              3591011842654386u,
                              9228616714210784205u,
                              9973669472204895162u,
                              14011001112246962877u,
                              12406186145184390807u,
                              15849039046786891736u,
                              10450023813501588000u};
  for (const uint64_t expected : outputs) EXPECT_EQ(rng.next_bits(), expected);
}

TEST(Rng, MixesAsSplitMixDoes) {
  uint64_t x = 1234567;
  for (const uint64_t expected : {6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
                                  4593380528125082431u, 16408922859458223821u}) {
    EXPECT_EQ(mix_bits(x), expected);
    x += 0x9e3779b97f4a7c15u;
  }
}

TEST(Rng, IsAValue) {
  Rng a(1, Purpose::test, 2);
  a.next();
  Rng copy = a, stored(a.state());
  for (int i = 0; i < 100; ++i) {
    const uint64_t bits = a.next_bits();
    EXPECT_EQ(copy.next_bits(), bits);
    EXPECT_EQ(stored.next_bits(), bits);
  }
}

TEST(Rng, NamesOfStreamsDoNotCollide) {
  std::set<Rng::State> states;
  size_t count = 0;
  for (uint64_t seed = 0; seed < 32; ++seed)
    for (uint64_t purpose = 0; purpose < 8; ++purpose)
      for (uint64_t index = 0; index < 256; ++index, ++count)
        states.insert(Rng(seed, static_cast<Purpose>(purpose), index).state());
  EXPECT_EQ(states.size(), count);
}

TEST(Rng, NumbersAreBelowOne) {
  // The largest output: s0 = 0 and rotate(s3, 23) = all ones.
  Rng rng(Rng::State{0, 0, 0, ~uint64_t{0}});
  EXPECT_EQ(rng.next(), 1 - 0x1p-53);
  Rng again(Rng::State{0, 0, 0, ~uint64_t{0}});
  EXPECT_EQ(again.below(10), 9u);
}

/// Chi-square of pairs of numbers against uniformity on a grid.
template <class Pair>
double grid_p_value(int samples, const Pair& pair) {
  constexpr int n = 32;
  std::vector<double> counts(n * n), expected(n * n, static_cast<double>(samples) / (n * n));
  for (int i = 0; i < samples; ++i) {
    const auto [x, y] = pair(static_cast<uint64_t>(i));
    counts[static_cast<int>(x * n) * n + static_cast<int>(y * n)] += 1;
  }
  return chi_square_counts(counts, expected).p_value;
}

using Numbers = std::pair<double, double>;

TEST(Rng, SuccessiveNumbersAreUniformAndIndependent) {
  Rng rng(3, Purpose::test, 0);
  EXPECT_GT(grid_p_value(200'000,
                         [&](uint64_t) -> Numbers {
                           const double x = rng.next();
                           return {x, rng.next()};
                         }),
            alpha);
}

TEST(Rng, FirstNumbersOfNeighbouringStreamsAreIndependent) {
  const auto first = [](uint64_t seed, Purpose purpose, uint64_t index) {
    return Rng(seed, purpose, index).next();
  };
  EXPECT_GT(grid_p_value(200'000,
                         [&](uint64_t i) -> Numbers {
                           return {first(1, Purpose::test, i), first(1, Purpose::test, i + 1)};
                         }),
            alpha);
  EXPECT_GT(grid_p_value(200'000,
                         [&](uint64_t i) -> Numbers {
                           return {first(i, Purpose::test, 0), first(i + 1, Purpose::test, 0)};
                         }),
            alpha);
  EXPECT_GT(grid_p_value(200'000,
                         [&](uint64_t i) -> Numbers {
                           return {first(1, Purpose::chain, i), first(1, Purpose::pixel, i)};
                         }),
            alpha);
}

TEST(Rng, TheGridTestFindsATiedPair) {
  EXPECT_LT(grid_p_value(200'000,
                         [](uint64_t i) -> Numbers {
                           const double x = Rng(1, Purpose::test, i).next(),
                                        y = Rng(1, Purpose::chain, i).next();
                           return {x, y < 0.1 ? x : y};
                         }),
            alpha);
}

TEST(Rng, BelowIsUniform) {
  for (const uint64_t n : {2, 3, 6, 100}) {
    Rng rng(n, Purpose::test, 1);
    std::vector<double> counts(n), expected(n, 100'000.0 / static_cast<double>(n));
    for (int i = 0; i < 100'000; ++i) {
      const uint64_t k = rng.below(n);
      ASSERT_LT(k, n);
      counts[k] += 1;
    }
    EXPECT_GT(chi_square_counts(counts, expected).p_value, alpha) << n;
  }
  Rng rng(1, Purpose::test, 2);
  EXPECT_EQ(rng.below(1), 0u);
}

}  // namespace
}  // namespace mlt
