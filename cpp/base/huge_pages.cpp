#include "base/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace mlt {

void prefer_huge_pages([[maybe_unused]] const void* data, [[maybe_unused]] size_t bytes) {
#ifdef MADV_HUGEPAGE
  constexpr uintptr_t page = uintptr_t{1} << 21;
  const auto address = reinterpret_cast<uintptr_t>(data);
  const uintptr_t begin = (address + page - 1) / page * page, end = (address + bytes) / page * page;
  if (begin >= end) return;
  void* const first = reinterpret_cast<void*>(begin);
  if (madvise(first, end - begin, MADV_HUGEPAGE) != 0) return;
  constexpr int collapse = 25;  // MADV_COLLAPSE, at once: Linux 6.1
  madvise(first, end - begin, collapse);
#endif
}

}  // namespace mlt
