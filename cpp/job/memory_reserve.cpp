#include "job/memory_reserve.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <fstream>

namespace mlt {

bool MemoryReserve::take(size_t bytes, size_t beside) {
  release();
  const size_t all = bytes + beside;
  void* start = ::mmap(nullptr, all, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (start == MAP_FAILED) return false;
  ::munmap(start, all);
  start = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                 MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (start == MAP_FAILED) return false;
  start_ = start;
  size_ = bytes;
  return true;
}

void MemoryReserve::release() {
  if (start_) ::munmap(start_, size_);
  start_ = nullptr;
}

size_t available_memory() {
  // man 5 proc; and the limit of a container, where it has one
  std::ifstream lines("/proc/meminfo");
  std::string name, unit;
  for (size_t kilobytes = 0; lines >> name >> kilobytes; std::getline(lines, unit))
    if (name == "MemAvailable:") {
      size_t limit = 0;  // stays 0 for "max"
      std::ifstream("/sys/fs/cgroup/memory.max") >> limit;
      return limit == 0 ? kilobytes * 1024 : std::min(kilobytes * 1024, limit);
    }
  return 0;
}

std::string in_words(size_t bytes) {
  const double size = static_cast<double>(bytes);
  return size < 1e9 ? fmt::format("{:.0f} MB", size / 1e6) : fmt::format("{:.1f} GB", size / 1e9);
}

}  // namespace mlt
