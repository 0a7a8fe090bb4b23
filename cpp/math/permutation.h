// Pseudo-random permutations of small ranges without a table, and points stratified by them.
#pragma once

#include "base/rng.h"
#include "math/vec.h"

#include <cstdint>

namespace mlt {

/// The image of i under a permutation of {0, ..., n - 1} that `key` names: rounds of a bijective
/// mixer on the next power of two, repeated until the result is in range (cycle walking, Black &
/// Rogaway 2002). A rotation at the end makes the image of every single i exactly uniform over the
/// keys.
inline uint32_t permute(uint32_t i, uint32_t n, uint64_t key) {
  uint32_t mask = n - 1;
  for (int shift = 1; shift < 32; shift *= 2) mask |= mask >> shift;
  const int half = std::max(1, __builtin_popcount(mask) / 2);
  do {
    uint64_t k = key;
    for (int round = 0; round < 4; ++round) {
      k = mix_bits(k);
      i = ((i ^ static_cast<uint32_t>(k)) & mask);
      i = (i * ((static_cast<uint32_t>(k >> 32) << 1) | 1)) & mask;
      i ^= i >> half;
    }
  } while (i >= n);
  const uint64_t shift = ((mix_bits(~key) >> 32) * n) >> 32;
  const uint64_t rotated = i + shift;
  return static_cast<uint32_t>(rotated < n ? rotated : rotated - n);
}

/// Point i of n points in the unit square, each in a cell of its own of a grid and uniform by
/// itself.
inline Vec2 stratified_point(uint32_t i, uint32_t n, uint64_t key) {
  const auto columns = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  const uint32_t rows = (n + columns - 1) / columns;
  const uint32_t cell = permute(i, columns * rows, key);
  const uint64_t bits = mix_bits(mix_bits(key) + i);
  const Vec2 jitter(static_cast<double>(bits >> 32) * 0x1p-32,
                    static_cast<double>(bits & 0xffffffffu) * 0x1p-32);
  return {(cell % columns + jitter.x) / columns, (cell / columns + jitter.y) / rows};
}

}  // namespace mlt
