#include "base/parallel.h"

#include "base/abandon.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace mlt {

int hardware_threads() { return std::max(1u, std::thread::hardware_concurrency()); }

void parallel_for(int threads, uint64_t count, const std::function<void(uint64_t)>& body) {
  std::atomic<uint64_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const std::atomic<bool>* flag = Abandonable::current();
  const auto work = [&] {
    const Abandonable abandonable(flag);
    for (uint64_t i = next++; i < count; i = next++) {
      try {
        body(i);
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> workers;
  const uint64_t wanted = std::min<uint64_t>(std::max(1, threads), count);
  try {
    for (uint64_t i = 1; i < wanted; ++i) workers.emplace_back(work);
  } catch (const std::system_error&) {  // no more threads: go on with those there are
  }
  work();
  for (std::thread& worker : workers) worker.join();
  if (failure) std::rethrow_exception(failure);
}

void parallel_blocks(int threads, uint64_t count,
                     const std::function<void(uint64_t, uint64_t)>& body) {
  constexpr uint64_t block = 256;
  parallel_for(threads, (count + block - 1) / block,
               [&](uint64_t i) { body(i * block, std::min(count, (i + 1) * block)); });
}

}  // namespace mlt
