// A loop on several threads does each index once, and tells what went wrong.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace mlt {
namespace {

TEST(ParallelFor, DoesEachIndexOnce) {
  for (const int threads : {-1, 0, 1, 2, 3, 8, 64})
    for (const uint64_t count : {0, 1, 2, 63, 10'000}) {
      std::vector<std::atomic<int>> done(count);
      parallel_for(threads, count, [&](uint64_t i) { ++done[i]; });
      for (const auto& d : done) ASSERT_EQ(d, 1) << threads << " threads, " << count;
    }
}

TEST(ParallelFor, GoesInOrderOnOneThread) {
  std::vector<uint64_t> order, expected(100);
  std::iota(expected.begin(), expected.end(), uint64_t{0});
  parallel_for(1, 100, [&](uint64_t i) { order.push_back(i); });
  EXPECT_EQ(order, expected);
}

TEST(ParallelFor, UsesTheThreadsItIsGiven) {
  // Each index waits for the other: one thread alone would not end.
  std::atomic<int> arrived{0};
  parallel_for(2, 2, [&](uint64_t) {
    ++arrived;
    while (arrived < 2) std::this_thread::yield();
  });
  EXPECT_EQ(arrived, 2);
}

TEST(ParallelFor, RethrowsAndStops) {
  for (const int threads : {1, 2, 4}) {
    std::atomic<uint64_t> done{0};
    try {
      parallel_for(threads, 1'000'000'000'000, [&](uint64_t i) {
        if (i == 1000) throw std::runtime_error("index 1000");
        ++done;
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "index 1000");
    }
    if (threads == 1) {
      EXPECT_EQ(done, 1000u);
    }
  }
}

TEST(ParallelFor, SurvivesManyExceptionsAtOnce) {
  EXPECT_THROW(parallel_for(4, 1000, [](uint64_t i) { throw static_cast<int>(i); }), int);
}

TEST(ParallelFor, CanBeNested) {
  std::atomic<int> done{0};
  parallel_for(2, 10, [&](uint64_t) { parallel_for(2, 10, [&](uint64_t) { ++done; }); });
  EXPECT_EQ(done, 100);
}

TEST(ParallelFor, TheMachineHasAThread) { EXPECT_GE(hardware_threads(), 1); }

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// In a process of its own: no room for the stacks of so many threads.
[[noreturn]] void loop_without_memory() {
  const rlimit limit{rlim_t{1} << 30, rlim_t{1} << 30};
  if (setrlimit(RLIMIT_AS, &limit) != 0) std::_Exit(2);
  std::atomic<uint64_t> done{0};
  parallel_for(100'000, 100'000, [&](uint64_t) { ++done; });
  std::_Exit(done == 100'000 ? 0 : 1);
}

TEST(ParallelForDeathTest, GoesOnWhenNoMoreThreadsCanBeHad) {
  testing::GTEST_FLAG(death_test_style) = "threadsafe";
  EXPECT_EXIT(loop_without_memory(), testing::ExitedWithCode(0), "");
}
#endif

}  // namespace
}  // namespace mlt
