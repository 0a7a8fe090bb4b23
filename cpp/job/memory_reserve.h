// Memory for the end of a render, reserved before it begins: an image that cannot be written is
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

  /// Reserves address space, which takes memory only when it is used. False if `bytes` and, for the
  /// work in between, `beside` bytes more cannot be allocated now.
  bool take(size_t bytes, size_t beside);
  void release();

 private:
  void* start_ = nullptr;
  size_t size_ = 0;
};

/// Bytes of memory that are available without swapping, or 0 if that is not known.
size_t available_memory();

/// A number of bytes in words, such as "1.2 GB".
std::string in_words(size_t bytes);

}  // namespace mlt
