// Randomised low-discrepancy points: the (0,2)-sequence of Sobol' in pairs of dimensions, each
// pair with its own Owen scrambling (Owen 1995) by hashing (Burley 2020, "Practical hash-based Owen
// scrambling", with the Laine-Karras permutation).
#pragma once

#include "base/rng.h"
#include "math/vec.h"

#include <array>
#include <cstdint>

namespace mlt {

inline uint32_t reverse_bits(uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

/// A permutation in which bit i depends on bits 0 ... i only: Owen scrambling of reversed bits.
inline uint32_t scramble_reversed(uint32_t x, uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

/// The second dimension of Sobol', with its bits in reversed order, from the index: Pascal's matrix
/// modulo 2 (the first dimension is the index itself).
inline uint32_t sobol_1_reversed(uint32_t index) {
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 16) & 0x0000ffffu;
  return index;
}

/// Point `index` of the sequences that `seed`, `seed` + 1, ... name, in [0, 1)^2. Every power-of-two
/// block of a sequence is stratified in all elementary intervals. The sequences are independent, so
/// the middle loop does as many at a time as the processor's vectors hold.
template <size_t count>
std::array<Vec2, count> scrambled_sobol(uint32_t index, uint64_t seed) {
  constexpr size_t lanes = (count + 7) / 8 * 8;
  uint32_t key_shuffle[lanes] = {}, key_x[lanes] = {}, key_y[lanes] = {}, x[lanes], y[lanes];
  for (size_t i = 0; i < count; ++i) {
    const uint64_t keys = mix_bits(seed + i);
    key_shuffle[i] = static_cast<uint32_t>(keys);
    key_x[i] = static_cast<uint32_t>(keys >> 32);
    key_y[i] = static_cast<uint32_t>(mix_bits(keys));
  }
  const uint32_t reversed = reverse_bits(index);
  for (size_t i = 0; i < lanes; ++i) {
    const uint32_t shuffled = reverse_bits(scramble_reversed(reversed, key_shuffle[i]));
    x[i] = reverse_bits(scramble_reversed(shuffled, key_x[i]));
    y[i] = reverse_bits(scramble_reversed(sobol_1_reversed(shuffled), key_y[i]));
  }
  std::array<Vec2, count> points;
  for (size_t i = 0; i < count; ++i) points[i] = {x[i] * 0x1p-32, y[i] * 0x1p-32};
  return points;
}

inline Vec2 scrambled_sobol(uint32_t index, uint64_t seed) {
  return scrambled_sobol<1>(index, seed)[0];
}

}  // namespace mlt
