// Running a loop on several threads. Which thread does which index is left open, so the body must
// not depend on it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

namespace mlt {

/// As many threads as the machine has, at least 1.
int hardware_threads();

/// For work that nobody will cancel.
inline const std::atomic<bool> never_cancelled{false};

/// Calls body(0) ... body(count - 1), handing out indices in increasing order. The first exception
/// stops the loop and is rethrown.
void parallel_for(int threads, uint64_t count, const std::function<void(uint64_t)>& body);

/// The same in blocks, for work that keeps its memory from index to index: calls body(first, end)
/// for first = 0, 256, 512, ...
void parallel_blocks(int threads, uint64_t count,
                     const std::function<void(uint64_t, uint64_t)>& body);

}  // namespace mlt
