// Running a loop on several threads. Any thread may run any index, so the body must not depend on
// its thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

namespace mlt {

/// The number of threads of the machine, at least 1.
int hardware_threads();

/// The flag of work that is never cancelled.
inline const std::atomic<bool> never_cancelled{false};

/// Calls body(0) ... body(count - 1), handing out indices in increasing order. The first exception
/// stops the loop and is rethrown.
void parallel_for(int threads, uint64_t count, const std::function<void(uint64_t)>& body);

/// Runs a loop in blocks, for work that reuses its buffers from index to index: calls body(first,
/// end) for first = 0, 256, 512, ...
void parallel_blocks(int threads, uint64_t count,
                     const std::function<void(uint64_t, uint64_t)>& body);

/// The number of parts of in_parts().
inline constexpr uint64_t part_count = 64;

/// Runs a loop in parts, each on one thread: calls body(part, first, end). The parts, and what is
/// summed in them, do not depend on the number of threads.
template <class Body>
void in_parts(int threads, uint64_t count, Body&& body) {
  parallel_for(threads, part_count, [&](uint64_t part) {
    body(part, count * part / part_count, count * (part + 1) / part_count);
  });
}

}  // namespace mlt
