// Tables that are read at random places: with the pages of 4 KiB that are usual, most reads miss
// the table of pages, too.
#pragma once

#include <cstddef>

namespace mlt {

/// Moves the whole pages of 2 MiB of this memory into huge pages, if the system has them to give.
void prefer_huge_pages(const void* data, size_t bytes);

}  // namespace mlt
