// A render whose parts are run by copies of it has the same bits as one that nobody divided.
#include <gtest/gtest.h>

#include "integrator_testing.h"
#include "render/division.h"

#include <algorithm>

namespace mlt {
namespace {

using namespace test;

constexpr uint64_t seed = 5;

std::string outcome(const Division& division, size_t part, uint64_t to,
                    const IntegratorPtr& algorithm, int threads) {
  const std::atomic<bool> cancelled{false};
  return carry_out(division.order(part, to), lights_on_tiles(), *algorithm, threads, cancelled);
}

/// Takes every part to `units` in steps, the last part first.
void run_divided(Rendering& rendering, const IntegratorPtr& algorithm, int wanted, uint64_t units,
                 uint64_t step, int threads) {
  Division division(rendering, seed, wanted, 0);
  uint64_t done = 0;
  for (uint64_t to = std::min(step, units);; to = std::min(to + step, units)) {
    for (size_t part = division.parts(); part-- > 0;)
      done += division.fold(part, outcome(division, part, to, algorithm, threads));
    if (to == units) break;
  }
  EXPECT_EQ(done, units);
}

TEST(Division, ChangesNoBit) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto whole = rendered(lights_on_tiles(), made, seed, 5);
    const uint64_t units = whole->unit_count(5);
    for (const auto& [wanted, threads] : {std::pair(1, 1), std::pair(35, 2)}) {
      const auto divided = prepared(lights_on_tiles(), made, seed);
      run_divided(*divided, made, wanted, units, units / 3 + 7, threads);
      EXPECT_TRUE(divided->image() == whole->image());
      EXPECT_EQ(divided->save(), whole->save());
      const auto layers = divided->layers(), expected = whole->layers();
      ASSERT_EQ(layers.size(), expected.size());
      for (size_t i = 0; i < layers.size(); ++i) EXPECT_TRUE(layers[i].image == expected[i].image);
      Stats a, b;
      divided->add_stats(a);
      whole->add_stats(b);
      EXPECT_EQ(a.rays_intersect, b.rays_intersect);
      EXPECT_EQ(a.rays_occluded, b.rays_occluded);
    }
  }
}

TEST(Division, CanBecomeFinerOnTheWay) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto whole = rendered(lights_on_tiles(), made, seed, 3),
               divided = prepared(lights_on_tiles(), made, seed);
    Division division(*divided, seed, 1, 0);
    const size_t coarse = division.parts();
    for (const uint64_t to : {whole->unit_count(1), whole->unit_count(2), whole->unit_count(3)}) {
      const size_t parts = division.parts();
      for (size_t part = 0; part < parts; ++part) {
        division.fold(part, outcome(division, part, to, made, 1));
        if (part % 2 == 0) division.split(part);
      }
    }
    const bool can_be_split = divided->share_count() > coarse;
    EXPECT_EQ(division.parts() > coarse, can_be_split);
    for (size_t part = coarse; part < division.parts(); ++part)
      division.fold(part, outcome(division, part, whole->unit_count(3), made, 1));
    EXPECT_EQ(divided->save(), whole->save());
  }
}

TEST(Division, CutsEveryShareIntoOnePart) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const auto rendering =
        prepared(lights_on_tiles(), integrator(algorithm.name, algorithm.assignments), seed);
    for (const int wanted : {1, 16, 17, 35, 100000}) {
      uint64_t next = 0;
      for (const Part& part : rendering->parts(wanted)) {
        EXPECT_EQ(part.first, next);
        EXPECT_GT(part.last, part.first);
        next = part.last;
      }
      EXPECT_EQ(next, rendering->share_count());
    }
  }
}

TEST(Division, CountsNothingTwice) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto rendering = prepared(lights_on_tiles(), made, seed);
    Division division(*rendering, seed, 1, 0);
    const uint64_t units = rendering->unit_count(40);
    const std::string first = outcome(division, 0, units, made, 1);
    EXPECT_EQ(first, outcome(division, 0, units, made, 2)) << "an order has more than one outcome";
    EXPECT_GT(division.fold(0, first), 0u);
    const std::string once = rendering->save();
    EXPECT_THROW(division.fold(0, first), RenderError);
    EXPECT_THROW(division.fold(division.parts() - 1, first.substr(0, first.size() / 2)),
                 RenderError);
    EXPECT_EQ(rendering->save(), once);
  }
}

TEST(Division, LeavesAStateThatOneMachineGoesOnFrom) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto whole = rendered(lights_on_tiles(), made, seed, 4),
               divided = prepared(lights_on_tiles(), made, seed);
    Division division(*divided, seed, 7, 0);
    const uint64_t units = whole->unit_count(4);
    for (size_t part = 0; part < division.parts(); ++part)
      division.fold(part, outcome(division, part, units / (1 + part % 3), made, 1));
    EXPECT_LE(division.done(), units / 2);
    const auto second = made->start(lights_on_tiles(), seed);
    second->load(divided->save());
    run_units(*second, division.done(), units, 2);
    EXPECT_EQ(second->save(), whole->save());
  }
}

TEST(Division, PassesOverPartsThatHaveNothingToDo) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto rendering = prepared(lights_on_tiles(), made, seed);
    Division division(*rendering, seed, 1, 0);
    const uint64_t units = rendering->unit_count(1);
    for (size_t part = 0; part < division.parts(); ++part) {
      const std::string came = outcome(division, part, units, made, 1);
      const bool idle = division.pass(part, units);
      EXPECT_EQ(division.position(part), idle ? units : 0);
      if (!idle) {
        EXPECT_GT(division.fold(part, came), 0u);
      }
    }
    const auto whole = rendered(lights_on_tiles(), made, seed, 1);
    EXPECT_TRUE(rendering->image() == whole->image());
  }
}

TEST(Division, GoesOnWhereACancelledOrderStopped) {
  const IntegratorPtr made =
      integrator("pssmlt", {{"chains", "40"}, {"luminance_samples", "4000"}});
  const auto rendering = prepared(lights_on_tiles(), made, seed);
  Division division(*rendering, seed, 1, 0);
  const std::atomic<bool> cancelled{true};
  const uint64_t units = rendering->unit_count(3);
  EXPECT_EQ(
      division.fold(0, carry_out(division.order(0, units), lights_on_tiles(), *made, 1, cancelled)),
      0u);
  EXPECT_EQ(division.position(0), 0u);
  EXPECT_GT(division.fold(0, outcome(division, 0, units, made, 1)), 0u);
  EXPECT_EQ(division.position(0), units);
}

}  // namespace
}  // namespace mlt
