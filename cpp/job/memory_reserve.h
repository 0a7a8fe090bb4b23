// Memory for the end of a render, set aside before it begins: an image that cannot be written is
// not worth waiting for.
#pragma once

#include <cstddef>
#include <string>

namespace mlt {

class MemoryReserve {
 public:
  MemoryReserve() = default;
  ~MemoryReserve() { release(); }
  MemoryReserve(const MemoryReserve&) = delete;
  MemoryReserve& operator=(const MemoryReserve&) = delete;

  /// Sets aside address space, which becomes memory only when it is used. False if there is no
  /// such space now with `beside` bytes more, which are for the work in between.
  bool take(size_t bytes, size_t beside);
  void release();

 private:
  void* start_ = nullptr;
  size_t size_ = 0;
};

/// What the machine could give now without swapping, or 0 if it does not tell.
size_t available_memory();

/// "1.2 GB".
std::string in_words(size_t bytes);

}  // namespace mlt
