#include "math/weight_sums.h"

#include <gtest/gtest.h>

#include <limits>

namespace mlt::test {
namespace {

TEST(WeightClasses, TellHowManyCarryHalf) {
  WeightClasses classes;
  EXPECT_EQ(classes.carrying_half(), 0u);
  for (int i = 0; i < 1000; ++i) classes.add(1);
  EXPECT_NEAR(static_cast<double>(classes.carrying_half()), 500, 1);
  for (int i = 0; i < 20; ++i) classes.add(100);  // 2000 of 3000
  EXPECT_NEAR(static_cast<double>(classes.carrying_half()), 15, 1);
}

/// One class of so many weights, as a file has it.
WeightClasses loaded(int index, uint64_t count) {
  ByteWriter writer;
  writer.write<uint64_t>(1);
  writer.write(index);
  writer.write(count);
  const std::string bytes = writer.take();
  ByteReader reader(bytes);
  WeightClasses classes;
  classes.load(reader);
  return classes;
}

TEST(WeightClasses, OfEveryNumberAreReadAgain) {
  using Limits = std::numeric_limits<double>;
  for (const double weight : {Limits::min(), 1.0, Limits::max()}) {
    WeightClasses classes;
    classes.add(weight);
    ByteWriter writer;
    classes.save(writer);
    const std::string bytes = writer.take();
    ByteReader reader(bytes);
    classes.load(reader);
    EXPECT_EQ(classes.carrying_half(), 1u);
  }
  EXPECT_NO_THROW(loaded(static_cast<int>(4 * std::log2(Limits::denorm_min())), 1));
  constexpr auto most = std::numeric_limits<uint64_t>::max();
  EXPECT_EQ(loaded(4096, most).carrying_half(), most);  // its sum is infinite
}

TEST(WeightClasses, OfNoNumberAreRefused) {
  for (const int index : {-4297, 4097, 1 << 30, -(1 << 30)})
    EXPECT_THROW(loaded(index, 5), RenderError) << index;
}

TEST(Estimates, OfStrataWeighThemByTheirSize) {
  MeanSums a, b;
  for (const double x : {1.0, 3.0}) a.add(x);
  for (const double x : {10.0, 10.0, 10.0, 10.0}) b.add(x);
  const Estimate both = stratified({a, b}, {1, 3});
  EXPECT_DOUBLE_EQ(both.mean, 0.25 * 2 + 0.75 * 10);
  EXPECT_DOUBLE_EQ(both.variance, 0.25 * 0.25 * 1);
  EXPECT_EQ(both.count, 6u);
  EXPECT_EQ(stratified({a, MeanSums()}, {1, 1}).count, 0u);
}

TEST(Estimates, ArePooledByTheirNumbers) {
  const Estimate both = pooled({1, 0.1, 30}, {2, 0.3, 10});
  EXPECT_DOUBLE_EQ(both.mean, 1.25);
  EXPECT_DOUBLE_EQ(both.variance, 0.75 * 0.75 * 0.1 + 0.25 * 0.25 * 0.3);
  EXPECT_EQ(both.count, 40u);
  EXPECT_EQ(pooled({}, {}).count, 0u);
}

}  // namespace
}  // namespace mlt::test
