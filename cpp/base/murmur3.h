// MurmurHash3_x86_32 of Austin Appleby, who has placed it in the public domain, with the seed 0.
#pragma once

#include <cstdint>
#include <string_view>

namespace mlt {

uint32_t murmur3(std::string_view bytes);

}  // namespace mlt
