// Permutations without a table, and points stratified by them.
#include <gtest/gtest.h>

#include <set>

#include "harness/chi_square.h"
#include "math/permutation.h"

namespace mlt::test {
namespace {

TEST(Permutation, IsABijection) {
  for (const uint32_t n : {1u, 2u, 3u, 5u, 16u, 64u, 100u, 1000u, 1024u, 1025u})
    for (uint64_t key = 0; key < 20; ++key) {
      std::set<uint32_t> images;
      for (uint32_t i = 0; i < n; ++i) {
        const uint32_t image = permute(i, n, key);
        ASSERT_LT(image, n);
        images.insert(image);
      }
      ASSERT_EQ(images.size(), n) << "key " << key;
    }
}

TEST(Permutation, SendsEveryNumberEverywhere) {
  // Over many keys, each number has each image equally often.
  for (const uint32_t n : {5u, 24u, 64u})
    for (const uint32_t i : {0u, 1u, n - 1}) {
      constexpr int keys = 100000;
      std::vector<double> observed(n, 0.0), expected(n, static_cast<double>(keys) / n);
      for (uint64_t key = 0; key < keys; ++key) observed[permute(i, n, mix_bits(key))] += 1;
      const ChiSquareResult result = chi_square_counts(observed, expected);
      EXPECT_GT(result.p_value, 1e-4) << n << " " << i << ": " << result;
    }
}

TEST(StratifiedPoint, HasACellToItself) {
  for (const uint32_t n : {1u, 4u, 64u, 100u}) {
    const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(n)));
    const uint32_t rows = (n + columns - 1) / columns;
    std::set<uint32_t> cells;
    for (uint32_t i = 0; i < n; ++i) {
      const Vec2 p = stratified_point(i, n, 7);
      ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
      cells.insert(static_cast<uint32_t>(p.y * rows) * columns +
                   static_cast<uint32_t>(p.x * columns));
    }
    EXPECT_EQ(cells.size(), n);
  }
}

TEST(StratifiedPoint, IsUniformByItself) {
  for (const uint32_t n : {5u, 64u}) {
    const auto sample = [&](Rng& rng) -> std::optional<Vec2> {
      return stratified_point(2, n, rng.next_bits());
    };
    const ChiSquareResult result =
        chi_square_rect(sample, [](const Vec2&) { return 1.0; }, Vec2(0), Vec2(1), 100000, n);
    EXPECT_GT(result.p_value, 1e-4) << n << ": " << result;
  }
}

}  // namespace
}  // namespace mlt::test
