// A render whose tasks are run by copies of it has the same bits as one that runs all its units
// itself.
#include <gtest/gtest.h>

#include "integrator_testing.h"
#include "job/task.h"

#include <algorithm>

namespace mlt {
namespace {

using namespace test;

constexpr uint64_t seed = 5;

std::string result(const TaskList& tasks, size_t task, uint64_t to, const IntegratorPtr& algorithm,
                   int threads) {
  const std::atomic<bool> cancelled{false};
  return run(tasks.task(task, to), lights_on_tiles(), *algorithm, threads, cancelled);
}

/// Takes every task to `units`, so many units at a time, the last task first.
void run_tasks(Rendering& rendering, const IntegratorPtr& algorithm, int wanted, uint64_t units,
               uint64_t step, int threads) {
  TaskList tasks(rendering, seed, wanted, 0);
  uint64_t done = 0;
  for (uint64_t to = std::min(step, units);; to = std::min(to + step, units)) {
    for (size_t task = tasks.size(); task-- > 0;)
      done += tasks.merge(task, result(tasks, task, to, algorithm, threads));
    if (to == units) break;
  }
  EXPECT_EQ(done, units);
}

TEST(Tasks, ChangeNoBit) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto whole = rendered(lights_on_tiles(), made, seed, 5);
    const uint64_t units = whole->plan().unit_count(5);
    for (const auto& [wanted, threads] : {std::pair(1, 1), std::pair(35, 2)}) {
      const auto divided = prepared(lights_on_tiles(), made, seed);
      run_tasks(*divided, made, wanted, units, units / 3 + 7, threads);
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

TEST(Tasks, CanBeSplitOnTheWay) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto whole = rendered(lights_on_tiles(), made, seed, 3),
               divided = prepared(lights_on_tiles(), made, seed);
    TaskList tasks(*divided, seed, 1, 0);
    const size_t coarse = tasks.size();
    for (const uint64_t to :
         {whole->plan().unit_count(1), whole->plan().unit_count(2), whole->plan().unit_count(3)}) {
      const size_t count = tasks.size();
      for (size_t task = 0; task < count; ++task) {
        tasks.merge(task, result(tasks, task, to, made, 1));
        if (task % 2 == 0) tasks.split(task);
      }
    }
    const bool can_be_split = divided->plan().strand_count() > coarse;
    EXPECT_EQ(tasks.size() > coarse, can_be_split);
    for (size_t task = coarse; task < tasks.size(); ++task)
      tasks.merge(task, result(tasks, task, whole->plan().unit_count(3), made, 1));
    EXPECT_EQ(divided->save(), whole->save());
  }
}

TEST(Tasks, CutEveryShareIntoOneTask) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const auto rendering =
        prepared(lights_on_tiles(), integrator(algorithm.name, algorithm.assignments), seed);
    for (const int wanted : {1, 16, 17, 35, 100000}) {
      uint64_t next = 0;
      for (const Strands& strands : rendering->plan().cut(wanted)) {
        EXPECT_EQ(strands.first, next);
        EXPECT_GT(strands.last, strands.first);
        next = strands.last;
      }
      EXPECT_EQ(next, rendering->plan().strand_count());
    }
  }
}

TEST(Tasks, CountNothingTwice) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto rendering = prepared(lights_on_tiles(), made, seed);
    TaskList tasks(*rendering, seed, 1, 0);
    const uint64_t units = rendering->plan().unit_count(40);
    const std::string first = result(tasks, 0, units, made, 1);
    EXPECT_EQ(first, result(tasks, 0, units, made, 2)) << "a task has more than one result";
    EXPECT_GT(tasks.merge(0, first), 0u);
    const std::string once = rendering->save();
    EXPECT_THROW(tasks.merge(0, first), RenderError);
    EXPECT_THROW(tasks.merge(tasks.size() - 1, first.substr(0, first.size() / 2)), RenderError);
    EXPECT_EQ(rendering->save(), once);
  }
}

TEST(Tasks, LeaveAStateThatOneMachineGoesOnFrom) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto whole = rendered(lights_on_tiles(), made, seed, 4),
               divided = prepared(lights_on_tiles(), made, seed);
    TaskList tasks(*divided, seed, 7, 0);
    const uint64_t units = whole->plan().unit_count(4);
    for (size_t task = 0; task < tasks.size(); ++task)
      tasks.merge(task, result(tasks, task, units / (1 + task % 3), made, 1));
    EXPECT_LE(tasks.done(), units / 2);
    const auto second = made->start(lights_on_tiles(), seed);
    second->load(divided->save());
    run_units(*second, tasks.done(), units, 2);
    EXPECT_EQ(second->save(), whole->save());
  }
}

TEST(Tasks, SkipWhatHasNothingToDo) {
  for (const Algorithm& algorithm : algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const IntegratorPtr made = integrator(algorithm.name, algorithm.assignments);
    const auto rendering = prepared(lights_on_tiles(), made, seed);
    TaskList tasks(*rendering, seed, 1, 0);
    const uint64_t units = rendering->plan().unit_count(1);
    for (size_t task = 0; task < tasks.size(); ++task) {
      const std::string came = result(tasks, task, units, made, 1);
      const bool idle = tasks.skip(task, units);
      EXPECT_EQ(tasks.position(task), idle ? units : 0);
      if (!idle) {
        EXPECT_GT(tasks.merge(task, came), 0u);
      }
    }
    const auto whole = rendered(lights_on_tiles(), made, seed, 1);
    EXPECT_TRUE(rendering->image() == whole->image());
  }
}

TEST(Tasks, GoOnWhereACancelledOneStopped) {
  const IntegratorPtr made =
      integrator("pssmlt", {{"chains", "40"}, {"luminance_samples", "4000"}});
  const auto rendering = prepared(lights_on_tiles(), made, seed);
  TaskList tasks(*rendering, seed, 1, 0);
  const std::atomic<bool> cancelled{true};
  const uint64_t units = rendering->plan().unit_count(3);
  EXPECT_EQ(tasks.merge(0, run(tasks.task(0, units), lights_on_tiles(), *made, 1, cancelled)), 0u);
  EXPECT_EQ(tasks.position(0), 0u);
  EXPECT_GT(tasks.merge(0, result(tasks, 0, units, made, 1)), 0u);
  EXPECT_EQ(tasks.position(0), units);
}

}  // namespace
}  // namespace mlt
