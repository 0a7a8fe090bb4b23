// Random streams. A stream is named by (seed, purpose, index) and owned by a unit of work, never by
// a thread, so that a render does not depend on how many threads made it.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace mlt {

/// The purpose of a stream: two purposes never share random numbers.
enum class Purpose : uint64_t {
  bootstrap = 1,
  chain,
  pixel,
  test,
  resample,
  choice,
  map,
  pilot,
  inspect,
  allocation,
  sample,
  certain_light,
  manifold,
  exposures,
  boundary
};

/// SplitMix64 (Steele, Lea & Flood 2014): a bijective mixer of 64 bits.
inline uint64_t mix_bits(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// The finaliser of MurmurHash3 (Appleby 2011), after an offset: a bijective mixer of 32 bits.
inline uint32_t mix_bits_32(uint32_t x) {
  x += 0x9e3779b9u;
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  return x ^ (x >> 16);
}

/// The n-th number of SplitMix64's sequence from `key` on.
inline uint64_t nth_bits(uint64_t key, uint64_t n) {
  return mix_bits(key + n * 0x9e3779b97f4a7c15u);
}

/// Random bits as a number in [0, 1), a multiple of 2^-52, without a branch or a conversion.
inline double unit_interval(uint64_t bits) {
  const uint64_t exponent_of_one = 0x3ff0000000000000u, number = exponent_of_one | bits >> 12;
  double x;
  std::memcpy(&x, &number, sizeof(x));
  return x - 1;
}

/// xoshiro256++ (Blackman & Vigna 2019). Its state is a value: it can be copied, stored, compared.
class Rng {
 public:
  using State = std::array<uint64_t, 4>;

  Rng(uint64_t seed, Purpose purpose, uint64_t index) {
    uint64_t key = mix_bits(mix_bits(mix_bits(seed) ^ static_cast<uint64_t>(purpose)) ^ index);
    for (uint64_t& word : state_) word = key = mix_bits(key);
  }
  explicit Rng(const State& state) : state_(state) {}

  const State& state() const { return state_; }

  uint64_t next_bits() {
    const uint64_t result = rotate(state_[0] + state_[3], 23) + state_[0];
    const uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = rotate(state_[3], 45);
    return result;
  }

  /// A uniform number in [0, 1), a multiple of 2^-53.
  double next() { return static_cast<double>(next_bits() >> 11) * 0x1p-53; }

  /// A uniform integer in {0, ..., n - 1}.
  uint64_t below(uint64_t n) {
    return static_cast<uint64_t>((static_cast<unsigned __int128>(next_bits()) * n) >> 64);
  }

 private:
  static uint64_t rotate(uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }
  State state_;
};

}  // namespace mlt
