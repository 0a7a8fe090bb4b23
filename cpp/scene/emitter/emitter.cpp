#include "scene/emitter/emitter.h"

#include "scene/shape/shape.h"

namespace mlt {

Vec3 Emitter::middle(double time) const {
  Vec3 low, high;
  if (shape())
    shape()->bounds(low, high);
  else if (glowing())
    find_box(low, high);
  else
    return sample_position(Vec2(0.5), time).at.p;
  return 0.5 * (low + high);
}

}  // namespace mlt
