#include "math/sorted_rows.h"

#include "base/rng.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mlt::test {
namespace {

/// Rows that begin with 0 and never fall; many numbers are equal.
std::vector<uint32_t> random_rows(size_t rows, size_t width, Rng& rng) {
  std::vector<uint32_t> numbers;
  for (size_t row = 0; row < rows; ++row) {
    uint32_t number = 0;
    for (size_t i = 0; i < width; ++i) {
      numbers.push_back(number);
      number += static_cast<uint32_t>(rng.below(3));
    }
  }
  return numbers;
}

TEST(SortedRows, FindWhatASearchByHalvesFinds) {
  Rng rng(1, Purpose::test, 0);
  constexpr size_t rows = 3;
  constexpr uint32_t end = 1u << 31;
  for (const size_t width : {1, 2, 15, 16, 17, 31, 255, 256, 257, 4096, 5000}) {
    const std::vector<uint32_t> numbers = random_rows(rows, width, rng);
    const SortedRows<uint32_t> sorted(numbers, width, end);
    for (size_t row = 0; row < rows; ++row) {
      const auto begin = numbers.begin() + row * width;
      for (size_t i = 0; i < width; ++i) EXPECT_EQ(sorted.at(row, i), begin[i]);
      EXPECT_EQ(sorted.at(row, width), end);
      for (uint32_t x : {0u, end - 1, uint32_t(rng.below(width)), uint32_t(rng.below(width))})
        EXPECT_EQ(sorted.last_up_to(row, x) + 1,
                  size_t(std::upper_bound(begin, begin + width, x) - begin))
            << width << ' ' << x;
    }
  }
}

TEST(SortedRows, FindManyTogether) {
  Rng rng(2, Purpose::test, 0);
  for (const size_t width : {5, 16, 300, 5000}) {
    const SortedRows<uint32_t> sorted(random_rows(4, width, rng), width, 1u << 31);
    constexpr int count = 50;
    size_t rows[count], found[count];
    uint32_t numbers[count];
    for (int i = 0; i < count; ++i) {
      rows[i] = rng.below(4);
      numbers[i] = static_cast<uint32_t>(rng.below(width));
    }
    sorted.last_up_to(rows, numbers, count, found);
    for (int i = 0; i < count; ++i)
      EXPECT_EQ(found[i], sorted.last_up_to(rows[i], numbers[i])) << width;
  }
}

TEST(SortedRows, HaveRoomForNumbersOfAnySize) {
  std::vector<double> numbers;
  for (int i = 0; i < 1000; ++i) numbers.push_back(i / 1000.0);
  const SortedRows<double> sorted(numbers, numbers.size(), 1);
  EXPECT_EQ(sorted.last_up_to(0, 0), 0u);
  EXPECT_EQ(sorted.last_up_to(0, 0.7775), 777u);
  EXPECT_EQ(sorted.last_up_to(0, std::nextafter(1, 0)), 999u);
  EXPECT_EQ(sorted.at(0, 1000), 1);
}

}  // namespace
}  // namespace mlt::test
