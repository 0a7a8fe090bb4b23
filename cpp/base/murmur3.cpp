#include "base/murmur3.h"

namespace mlt {
namespace {

uint32_t rotated(uint32_t x, int bits) { return (x << bits) | (x >> (32 - bits)); }

/// Up to four bytes as a number, the lowest first, scrambled.
uint32_t scrambled(std::string_view bytes) {
  uint32_t block = 0;
  for (size_t i = bytes.size(); i-- > 0;) block = block << 8 | static_cast<unsigned char>(bytes[i]);
  return rotated(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

}  // namespace

uint32_t murmur3(std::string_view bytes) {
  uint32_t hash = 0;
  size_t position = 0;
  for (; position + 4 <= bytes.size(); position += 4) {
    hash ^= scrambled(bytes.substr(position, 4));
    hash = rotated(hash, 13) * 5 + 0xe6546b64u;
  }
  hash ^= scrambled(bytes.substr(position));
  hash ^= static_cast<uint32_t>(bytes.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

}  // namespace mlt
