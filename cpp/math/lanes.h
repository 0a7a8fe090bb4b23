// Values of the paths that are traced side by side: one array for each quantity, so that the
// compiler vectorises the loops over them.
#pragma once

#include "math/number.h"

namespace mlt {

/// Numbers of as many paths, side by side. They are not initialised: a wave is made for every
/// tile, and most of its numbers are written anyway.
template <class T, int size>
struct alignas(32) Lanes {
  T values[size];
  T& operator[](int i) { return values[i]; }
  const T& operator[](int i) const { return values[i]; }
  /// Eight floats from the i-th on.
  Float8 eight(int i) const { return Float8(&values[i], stdx::element_aligned); }
  void set_eight(int i, const Float8& x) { x.copy_to(&values[i], stdx::element_aligned); }
};

template <int size>
struct VectorLanes {
  Lanes<float, size> x, y, z;
  Vec3f operator[](int i) const { return {x[i], y[i], z[i]}; }
  void set(int i, const Vec3f& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
  Vec3Of<Float8> eight(int i) const { return {x.eight(i), y.eight(i), z.eight(i)}; }
  void set_eight(int i, const Vec3Of<Float8>& v) {
    x.set_eight(i, v.x);
    y.set_eight(i, v.y);
    z.set_eight(i, v.z);
  }
};

/// The number of paths that are traced together.
inline constexpr int wave_size = 512;
template <class T>
using Wave = Lanes<T, wave_size>;
using VectorWave = VectorLanes<wave_size>;

/// The number of paths that are shaded together, in the first-level cache.
inline constexpr int block_size = 64;
template <class T>
using Block = Lanes<T, block_size>;
using VectorBlock = VectorLanes<block_size>;

}  // namespace mlt
