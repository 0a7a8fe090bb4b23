// The film that adds in fixed point: the same bits in any order and on any number of threads, a
// known precision, and a range that tells when it is left.
#include "filters.h"
#include "image/splat_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/rng.h"

namespace mlt {
namespace {

constexpr int width = 24, height = 17, groups = 2;
using FilterPtr = std::shared_ptr<const Filter>;

FilterPtr shared(Filter filter) { return std::make_shared<const Filter>(std::move(filter)); }

struct Splat {
  int group;
  Vec2 at;
  Color color;
};

/// Colours of many sizes, and positions also beyond the border.
std::vector<Splat> splats(int count) {
  std::vector<Splat> splats;
  Rng rng(71, Purpose::test, 0);
  for (int i = 0; i < count; ++i) {
    const int group = static_cast<int>(rng.below(groups));
    const double x = rng.next() * (width + 4) - 2, y = rng.next() * (height + 4) - 2;
    const double r = 5 * rng.next(), g = std::exp(-20 * rng.next()), b = 5 * rng.next();
    splats.push_back({group, {x, y}, Color(r, g, b)});
  }
  return splats;
}

void add(SplatFilm& film, const Splat& s) { film.add(s.group, s.at, s.color); }

TEST(SplatFilm, HasTheSameBitsInAnyOrder) {
  std::vector<Splat> all = splats(20'000);
  const FilterPtr filter = shared(lanczos_filter());
  SplatFilm in_order(width, height, filter, groups);
  for (const Splat& s : all) add(in_order, s);
  Rng rng(72, Purpose::test, 0);
  for (int shuffles = 0; shuffles < 3; ++shuffles) {
    for (size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[rng.below(i)]);
    SplatFilm film(width, height, filter, groups);
    for (const Splat& s : all) add(film, s);
    EXPECT_EQ(film.save(0, groups), in_order.save(0, groups));
    EXPECT_TRUE(film.image({0.3, 0.7}) == in_order.image({0.3, 0.7}));
  }
}

TEST(SplatFilm, HasTheSameBitsForAnyNumberOfThreads) {
  const std::vector<Splat> all = splats(20'000);
  const FilterPtr filter = shared(gaussian_filter());
  SplatFilm in_order(width, height, filter, groups);
  for (const Splat& s : all) add(in_order, s);
  for (const int threads : {1, 2, 3, 4}) {
    SplatFilm film(width, height, filter, groups);
    parallel_for(threads, all.size(), [&](uint64_t i) { add(film, all[i]); });
    EXPECT_EQ(film.save(0, groups), in_order.save(0, groups)) << threads;
  }
}

TEST(SplatFilm, EachSplatIsRoundedOnceToHalfAUnit) {
  const std::vector<Splat> all = splats(5000);
  for (const Filter& each : test::default_filters()) {
    const FilterPtr filter = shared(each);
    SplatFilm film(width, height, filter, groups);
    std::vector<double> sum(3 * width * height), added(sum.size());
    const std::vector<double> scale{0.25, 1.5};
    for (const Splat& s : all) {
      add(film, s);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const double w = filter->eval(x + 0.5 - s.at.x) * filter->eval(y + 0.5 - s.at.y);
          if (w == 0) continue;
          for (int c = 0; c < 3; ++c) {
            const size_t i = 3 * (static_cast<size_t>(y) * width + x) + c;
            sum[i] += scale[s.group] * w * s.color[c];
            added[i] += scale[s.group];
          }
        }
    }
    const Image image = film.image(scale);
    EXPECT_EQ(film.saturated(), 0u);
    for (size_t i = 0; i < sum.size(); ++i)
      ASSERT_NEAR(image.data[i], sum[i], added[i] * 0x1p-29 + std::abs(sum[i]) * 0x1p-23)
          << each.name();
  }
}

TEST(SplatFilm, KeepsNegativeLobes) {
  const FilterPtr filter = shared(lanczos_filter());
  SplatFilm film(width, height, filter, 1);
  film.add(0, {10.5, 8.5}, Color(1));
  film.add(0, {10.9, 8.7}, Color(1));
  const Image image = film.image({1});
  EXPECT_LT(*std::min_element(image.data.begin(), image.data.end()), -0.01f);
}

/// Splats on a fine grid over the image alone.
TEST(SplatFilm, IsEvenUpToTheEdgesWithoutSplatsAroundTheImage) {
  constexpr int per_pixel = 32;
  for (const Filter& each : test::default_filters()) {
    SplatFilm film(9, 7, shared(each), 1, false);
    for (int y = 0; y < 7 * per_pixel; ++y)
      for (int x = 0; x < 9 * per_pixel; ++x)
        film.add(0, (Vec2(x, y) + 0.5) / double{per_pixel}, Color(1));
    const Image image = film.image({1.0 / (per_pixel * per_pixel)});
    for (const float value : image.data) ASSERT_NEAR(value, 1, 1e-3) << each.name();
  }
}

TEST(SplatFilm, WhatIsAddedAndTakenAwayLeavesNothing) {
  SplatFilm film(width, height, shared(mitchell_filter()), groups);
  const std::vector<Splat> all = splats(1000);
  for (const Splat& s : all) add(film, s);
  for (const Splat& s : all) film.add(s.group, s.at, -s.color);
  for (const float value : film.image({1, 1}).data) ASSERT_EQ(value, 0);
}

TEST(SplatFilm, GroupsHaveTheirOwnScale) {
  SplatFilm film(4, 4, shared(box_filter()), groups);
  film.add(0, {1.5, 1.5}, Color(1, 2, 3));
  film.add(1, {1.5, 1.5}, Color(10));
  EXPECT_EQ(film.group_count(), groups);
  EXPECT_EQ(film.image({1, 0}).at(1, 1, 2), 3.0f);
  EXPECT_EQ(film.image({0, 1}).at(1, 1, 2), 10.0f);
  EXPECT_EQ(film.image({2, 0.5}).at(1, 1, 0), 7.0f);
  EXPECT_EQ(film.image({1, 1}).at(2, 1, 0), 0.0f);
}

// ---- range: a sum can hold 2^63 units of 2^-28, and is reported from half of that on

TEST(SplatFilm, ReportsSumsThatLeaveTheRange) {
  SplatFilm film(4, 4, shared(box_filter()), 1);
  const double step = 0x1p32;
  for (int i = 0; i < 4; ++i) film.add(0, {1.5, 1.5}, Color(step, 0, 0));
  EXPECT_EQ(film.saturated(), 0u);
  EXPECT_EQ(film.image({1}).at(1, 1, 0), static_cast<float>(4 * step));
  film.add(0, {1.5, 1.5}, Color(step, 0, 0));
  EXPECT_EQ(film.saturated(), 0u);  // beyond half of the range, and still right
  film.add(0, {1.5, 1.5}, Color(step, 0, 0));
  EXPECT_EQ(film.saturated(), 1u);
  for (int i = 0; i < 1000; ++i) film.add(0, {2.5, 1.5}, Color(-step, 0, 0));
  EXPECT_GT(film.saturated(), 1u);
}

TEST(SplatFilm, ReportsAndLeavesOutWhatIsNoNumberOrTooLarge) {
  SplatFilm film(4, 4, shared(box_filter()), 1);
  film.add(0, {1.5, 1.5}, Color(1));
  uint64_t reported = 0;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), 0x1p40, -0x1p40, 1e300}) {
    film.add(0, {1.5, 1.5}, Color(0, bad, 0));
    EXPECT_EQ(film.saturated(), ++reported) << bad;
  }
  EXPECT_EQ(film.image({1}).at(1, 1, 1), 1.0f);
}

// ---- bytes

TEST(SplatFilm, GoesOnFromItsBytes) {
  const std::vector<Splat> all = splats(2000);
  const FilterPtr filter = shared(tent_filter());
  SplatFilm whole(width, height, filter, groups), first(width, height, filter, groups),
      second(width, height, filter, groups);
  for (const Splat& s : all) add(whole, s);
  for (size_t i = 0; i < all.size() / 2; ++i) add(first, all[i]);
  second.merge(0, groups, first.save(0, groups));
  for (size_t i = all.size() / 2; i < all.size(); ++i) add(second, all[i]);
  EXPECT_EQ(second.save(0, groups), whole.save(0, groups));
}

TEST(SplatFilm, RemembersThatItsRangeWasLeft) {
  SplatFilm film(4, 4, shared(box_filter()), 1), again(4, 4, shared(box_filter()), 1);
  film.add(0, {1.5, 1.5}, Color(1e300));
  again.merge(0, 1, film.save(0, 1));
  EXPECT_EQ(again.saturated(), film.saturated());
}

TEST(SplatFilm, RefusesDamagedBytesAndStaysAsItWas) {
  const FilterPtr filter = shared(tent_filter());
  SplatFilm saved(width, height, filter, groups), film(width, height, filter, groups);
  for (const Splat& s : splats(100)) add(saved, s);
  film.add(0, {3, 3}, Color(1));
  const std::string bytes = saved.save(0, groups), before = film.save(0, groups);
  const auto refuses = [&](const std::string& damaged) {
    EXPECT_THROW(film.merge(0, groups, damaged), RenderError);
    ASSERT_EQ(film.save(0, groups), before);
  };
  for (size_t size = 0; size < bytes.size(); size += 31) refuses(bytes.substr(0, size));
  refuses(bytes + '\0');
  refuses(SplatFilm(width, height + 1, filter, groups).save(0, groups));
  refuses(SplatFilm(width, height, filter, 1).save(0, 1));
  SplatFilm empty(width, height, filter, groups);
  empty.merge(0, groups, bytes);
  EXPECT_EQ(empty.save(0, groups), bytes);
}

}  // namespace
}  // namespace mlt
