#pragma once

#include "math/vec.h"

#include <cstdint>

namespace mlt {

struct Ray {
  Vec3 o;
  Vec3 d;  ///< Unit length.
  double time = 0;
  double t_max = infinity;
};

/// When it opens and closes.
struct Shutter {
  double open = 0, close = 0;
};

/// What the accelerator found: which primitive, and where on it (barycentrics of Embree).
struct Hit {
  double t;
  uint32_t shape;
  uint32_t primitive;
  float u, v;
  uint32_t member = 0;  ///< Of an instance: which shape of its group.
};

}  // namespace mlt
