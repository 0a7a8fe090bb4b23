#include "math/weight_sums.h"

#include <gtest/gtest.h>

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
