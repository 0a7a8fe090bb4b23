#include "base/buffer.h"

#include "base/rng.h"

#include <algorithm>
#include <cstring>

namespace mlt {

/// A chain of bijective mixers: h' = mix(h ^ word), eight bytes at a time.
uint64_t hash_of(std::string_view bytes) {
  uint64_t hash = mix_bits(0x6d6c742d7363656eu ^ bytes.size());
  for (size_t i = 0; i < bytes.size(); i += 8) {
    uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<size_t>(8, bytes.size() - i));
    hash = mix_bits(hash ^ word);
  }
  return hash;
}

}  // namespace mlt
