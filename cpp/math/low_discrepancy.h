// Randomised low-discrepancy points: the (0,2)-sequence of Sobol' in pairs of dimensions, each
// pair with its own Owen scrambling (Owen 1995) by hashing (Burley 2020, "Practical hash-based Owen
// scrambling", with the Laine-Karras permutation).
#pragma once

#include "base/rng.h"
#include "math/vec.h"

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

/// The key of a sequence, from the halves of its seed.
inline uint32_t sequence_key(uint32_t low, uint32_t high) {
  return mix_bits_32(mix_bits_32(low) ^ high);
}
/// The place of a point in the sequence in its order before shuffling.
inline uint32_t shuffled(uint32_t index, uint32_t key) {
  return reverse_bits(scramble_reversed(reverse_bits(index), key));
}
/// A scrambled coordinate, from its bits in reversed order.
inline double scrambled_coordinate(uint32_t reversed, uint32_t key) {
  return reverse_bits(scramble_reversed(reversed, key)) * 0x1p-32;
}

/// Computes point indices[i] in [0, 1)^2 of sequence seeds[i], for `count` sequences. Every
/// power-of-two block of a sequence is stratified in all elementary intervals. Sequences are
/// independent, so the compiler vectorises the loops.
template <int count>
void scrambled_sobol(const uint32_t* indices, const uint64_t* seeds, double* x, double* y) {
  uint32_t low[count], high[count];
  for (int i = 0; i < count; ++i) {
    low[i] = static_cast<uint32_t>(seeds[i]);
    high[i] = static_cast<uint32_t>(seeds[i] >> 32);
  }
  for (int i = 0; i < count; ++i) {
    const uint32_t key = sequence_key(low[i], high[i]);
    const uint32_t key_x = mix_bits_32(key + low[i]), key_y = mix_bits_32(key_x + low[i]);
    const uint32_t place = shuffled(indices[i], key);
    x[i] = scrambled_coordinate(place, key_x);
    y[i] = scrambled_coordinate(sobol_1_reversed(place), key_y);
  }
}

/// The first coordinates of the points of scrambled_sobol().
template <int count>
void scrambled_radical_inverse(const uint32_t* indices, const uint64_t* seeds, double* x) {
  for (int i = 0; i < count; ++i) {
    const auto low = static_cast<uint32_t>(seeds[i]);
    const uint32_t key = sequence_key(low, static_cast<uint32_t>(seeds[i] >> 32));
    x[i] = scrambled_coordinate(shuffled(indices[i], key), mix_bits_32(key + low));
  }
}

inline double scrambled_radical_inverse(uint32_t index, uint64_t seed) {
  double x;
  scrambled_radical_inverse<1>(&index, &seed, &x);
  return x;
}

inline Vec2 scrambled_sobol(uint32_t index, uint64_t seed) {
  Vec2 point;
  scrambled_sobol<1>(&index, &seed, &point.x, &point.y);
  return point;
}

}  // namespace mlt
