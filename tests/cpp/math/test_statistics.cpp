// The statistics that all other tests rely on, against tabulated values and closed forms.
#include "harness/statistics.h"

#include "base/rng.h"

#include <gtest/gtest.h>

namespace mlt::test {
namespace {

TEST(Statistics, ChiSquareTailMatchesClosedForms) {
  for (double x : {0.1, 1.0, 5.0, 40.0, 200.0}) {
    EXPECT_NEAR(chi_square_tail(x, 2) / std::exp(-x / 2), 1, 1e-12);
    EXPECT_NEAR(chi_square_tail(x, 1), std::erfc(std::sqrt(x / 2)), 1e-14);
  }
  // Abramowitz & Stegun, table 26.8.
  EXPECT_NEAR(chi_square_tail(124.342, 100), 0.05, 1e-6);
  EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 1e-5);
  EXPECT_EQ(chi_square_tail(0, 7), 1);
}

TEST(Statistics, StudentTMatchesClosedForms) {
  for (double t : {-30.0, -2.0, -0.3, 0.0, 0.7, 4.0}) {
    EXPECT_NEAR(student_t_cdf(t, 1), 0.5 + std::atan(t) / std::acos(-1.0), 1e-13);  // Cauchy
    EXPECT_NEAR(student_t_cdf(t, 2), 0.5 + t / (2 * std::sqrt(2 + t * t)), 1e-13);
  }
  EXPECT_NEAR(student_t_cdf(1.3, 1e7), normal_cdf(1.3), 1e-7);
  EXPECT_NEAR(student_t_quantile_two_sided(0.05, 10), 2.228139, 1e-6);
}

TEST(Statistics, WelchMatchesAWorkedExample) {
  const std::vector<double> a{27.5, 21.0, 19.0, 23.6, 17.0, 17.9, 16.9, 20.1,
                              21.9, 22.6, 23.1, 19.6, 19.0, 21.7, 21.4};
  const std::vector<double> b{27.1, 22.0, 20.8, 23.4, 23.4, 23.5, 25.8, 22.0,
                              24.8, 20.2, 21.9, 22.1, 22.9, 30.5, 24.2};
  const TTest test = welch_t_test(moments(a), moments(b));
  EXPECT_NEAR(test.t, -2.84132227138, 1e-9);
  EXPECT_NEAR(test.dof, 27.8825098418, 1e-9);
  EXPECT_NEAR(test.p_value, 0.00830342548332023, 1e-12);
}

TEST(Statistics, TTestKeepsItsLevelAndItsPower) {
  Rng rng(1, Purpose::test, 0);
  int false_alarms = 0, found = 0;
  constexpr int runs = 4000;
  for (int run = 0; run < runs; ++run) {
    Moments a, b;
    for (int i = 0; i < 16; ++i) {
      a.add(rng.next());
      b.add(rng.next() + rng.next());
    }
    const TTest test = welch_t_test(a, b);
    // The true difference is -1/2; removed, it is a false alarm to reject.
    false_alarms +=
        t_test(test.difference + 0.5, test.standard_error * test.standard_error, test.dof).p_value <
        0.05;
    // Shifted by what is detectable with power 0.9, it must be found about that often.
    const double shift = test.detectable(0.05, 0.9);
    found +=
        t_test(test.difference + 0.5 + shift, test.standard_error * test.standard_error, test.dof)
            .p_value < 0.05;
  }
  const double sigma_level = std::sqrt(0.05 * 0.95 / runs), sigma_power = std::sqrt(0.09 / runs);
  EXPECT_NEAR(false_alarms / double(runs), 0.05, 5 * sigma_level);
  EXPECT_NEAR(found / double(runs), 0.9, 5 * sigma_power);
}

TEST(Statistics, ConstantSamplesAreEqualOrNot) {
  const Moments ones = moments({1, 1, 1}), twos = moments({2, 2, 2});
  EXPECT_EQ(welch_t_test(ones, ones).p_value, 1);
  EXPECT_EQ(welch_t_test(ones, twos).p_value, 0);
  EXPECT_THROW(welch_t_test(ones, moments({1})), std::invalid_argument);
}

TEST(Statistics, HolmStepsDown) {
  const std::vector<double> p{0.01, 0.04, 0.03, 0.005};
  EXPECT_EQ(holm(p, 0.05), (std::vector<bool>{true, false, false, true}));
  const std::vector<double> adjusted = holm_adjusted(p);
  EXPECT_DOUBLE_EQ(adjusted[3], 0.02);
  EXPECT_DOUBLE_EQ(adjusted[0], 0.03);
  EXPECT_DOUBLE_EQ(adjusted[2], 0.06);
  EXPECT_DOUBLE_EQ(adjusted[1], 0.06);
  EXPECT_TRUE(holm({std::nan("")}, 1e-6)[0]);
}

}  // namespace
}  // namespace mlt::test
