// What the film relies on: every filter integrates to 1, is symmetric, ends at its radius, and has
// the shape that its formula says.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/rng.h"
#include "filters.h"
#include "image/filter_rows.h"
#include "math/vec.h"

namespace mlt {
namespace {

std::vector<Filter> all_filters() {
  std::vector<Filter> filters = test::default_filters();
  filters.push_back(box_filter(1.25));
  filters.push_back(tent_filter(0.7));
  filters.push_back(gaussian_filter(0.31));
  filters.push_back(mitchell_filter(0.1, 0.7));
  filters.push_back(lanczos_filter(2));
  return filters;
}

/// Gauss-Legendre with 4 points on every interval of a grid that is finer than, and not aligned
/// with, the table; inside the open support.
double integrate(const Filter& filter) {
  const double nodes[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                          0.8611363115940526};
  const double weights[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                            0.3478548451374538};
  const int cells = 1'000'003;
  const double h = 2 * filter.radius() / cells;
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < 4; ++k)
      sum += weights[k] * filter.eval(-filter.radius() + h * (i + 0.5 + 0.5 * nodes[k]));
  }
  return sum * h / 2;
}

TEST(Filter, IntegratesToOne) {
  for (const Filter& filter : all_filters())
    EXPECT_NEAR(integrate(filter), 1, 1e-9) << filter.name() << " " << filter.radius();
}

TEST(Filter, IsSymmetricInside) {
  Rng rng(1, Purpose::test, 0);
  for (const Filter& filter : all_filters()) {
    for (int i = 0; i < 10'000; ++i) {
      const double x = rng.next() * filter.radius();
      EXPECT_EQ(filter.eval(x), filter.eval(-x)) << filter.name();
    }
  }
}

TEST(Filter, IsZeroOutside) {
  for (const Filter& filter : all_filters()) {
    for (const double x :
         {std::nextafter(filter.radius(), 1e9), filter.radius() + 1, 1e9, infinity})
      EXPECT_EQ(filter.eval(x), 0) << filter.name();
    for (const double x : {-filter.radius(), -filter.radius() - 1, -1e9, -infinity})
      EXPECT_EQ(filter.eval(x), 0) << filter.name();
    EXPECT_EQ(filter.eval(std::nan("")), 0) << filter.name();
    if (filter.name() == "box") continue;
    EXPECT_NEAR(filter.eval(filter.radius()), 0, 1e-14) << filter.name();
  }
}

/// Shifted by whole pixels these sum to 1 for a sample anywhere.
TEST(Filter, IsAPartitionOfUnityWhereItShouldBe) {
  const std::vector<Filter> filters = {box_filter(), tent_filter(), catmullrom_filter(),
                                       mitchell_filter(), mitchell_filter(0.1, 0.7)};
  Rng rng(1, Purpose::test, 1);
  for (const Filter& filter : filters) {
    for (int k = 0; k < 10'000; ++k) {
      const double p = k < 8 ? k / 4.0 : 10 * rng.next();
      double sum = 0;
      for (int i = -5; i < 16; ++i) sum += filter.eval(i + 0.5 - p);
      EXPECT_NEAR(sum, 1, 1e-12) << filter.name() << " at " << p;
    }
  }
}

/// And these do not: the film must not rely on it.
TEST(Filter, GaussianAndLanczosAreNotAPartitionOfUnity) {
  for (const Filter& filter : {gaussian_filter(0.3), lanczos_filter()}) {
    double sum = 0;
    for (int i = -5; i < 6; ++i) sum += filter.eval(i);
    EXPECT_GT(std::abs(sum - 1), 1e-3) << filter.name();
  }
}

TEST(Filter, BoxIsExactlyThePixelOfTheSample) {
  const Filter box = box_filter();
  ASSERT_TRUE(box.is_box());
  EXPECT_FALSE(box_filter(1).is_box());
  EXPECT_FALSE(tent_filter(0.5).is_box());
  Rng rng(1, Purpose::test, 2);
  for (int k = 0; k < 10'000; ++k) {
    const double p = k < 20 ? k / 2.0 : 10 * rng.next();
    for (int i = -1; i < 12; ++i)
      EXPECT_EQ(box.eval(i + 0.5 - p), std::floor(p) == i ? 1 : 0) << i << " " << p;
  }
}

/// Ratios f(x) / f(0), worked out from the formulas (and equal to Mitsuba 3's to float accuracy).
TEST(Filter, HasTheShapeOfItsFormula) {
  const auto ratio = [](const Filter& filter, double x) { return filter.eval(x) / filter.eval(0); };
  const double cut = std::exp(-8.0);
  EXPECT_NEAR(ratio(tent_filter(), 0.3), 0.7, 1e-12);
  EXPECT_NEAR(ratio(gaussian_filter(), 0.75), (std::exp(-1.125) - cut) / (1 - cut), 1e-5);
  EXPECT_NEAR(ratio(gaussian_filter(), 1.5), (std::exp(-4.5) - cut) / (1 - cut), 1e-5);
  EXPECT_NEAR(mitchell_filter().eval(0), 8.0 / 9, 1e-5);
  EXPECT_NEAR(mitchell_filter().eval(1), 1.0 / 18, 1e-5);
  EXPECT_NEAR(mitchell_filter().eval(1.5), -0.034722222, 1e-5);
  EXPECT_NEAR(catmullrom_filter().eval(0.5), 0.5625, 1e-5);
  EXPECT_NEAR(catmullrom_filter().eval(1.5), -0.0625, 1e-5);
  EXPECT_NEAR(ratio(lanczos_filter(), 0.5), 6 / (pi * pi), 1e-5);
  EXPECT_NEAR(ratio(lanczos_filter(), 1.5), -0.13509491, 1e-5);
}

TEST(FilterRows, AreTheFilterAtConsecutivePixels) {
  Rng rng(1, Purpose::test, 0);
  int narrow = 0;
  for (const Filter& filter : all_filters()) {
    const FilterRows<float> rows(filter);
    if (rows.pixels() == 0) continue;
    ++narrow;
    for (int n = 0; n < 10'000; ++n) {
      const double at = n % 10 == 0 ? 0.5 * (n / 10 - 300) : 40 * rng.next() - 20;
      const FilterRows<float>::Weights weights = rows.weights(at);
      EXPECT_EQ(filter.eval(weights.first - 0.5 - at), 0);
      EXPECT_EQ(filter.eval(weights.first + rows.pixels() + 0.5 - at), 0);
      for (int k = 0; k < FilterRows<float>::most_pixels; ++k)
        ASSERT_NEAR(weights.at[k], filter.eval(weights.first + k + 0.5 - at), 1e-6)
            << filter.name() << " at " << at << ", pixel " << k;
    }
  }
  EXPECT_GE(narrow, 5);
}

TEST(Filter, HasMitsubasDefaults) {
  EXPECT_EQ(box_filter().radius(), 0.5);
  EXPECT_EQ(tent_filter().radius(), 1);
  EXPECT_EQ(gaussian_filter().radius(), 2);
  EXPECT_EQ(mitchell_filter().radius(), 2);
  EXPECT_EQ(catmullrom_filter().radius(), 2);
  EXPECT_EQ(lanczos_filter().radius(), 3);
}

TEST(Filter, RefusesWhatMakesNoFilter) {
  EXPECT_THROW(box_filter(0), UsageError);
  EXPECT_THROW(tent_filter(-1), UsageError);
  EXPECT_THROW(gaussian_filter(std::nan("")), UsageError);
  EXPECT_THROW(gaussian_filter(infinity), UsageError);
  EXPECT_THROW(mitchell_filter(1e9, 0), UsageError);
  EXPECT_THROW(lanczos_filter(0), UsageError);
  EXPECT_THROW(lanczos_filter(17), UsageError);
}

}  // namespace
}  // namespace mlt
