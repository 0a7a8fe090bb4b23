// What all lights of no size have in common: one position, which no walk can hit.
#pragma once

#include "scene/emitter.h"

namespace mlt {

class IsolatedEmitter : public Emitter {
 public:
  PositionSample sample_position(const Vec2&) const override {
    SurfacePoint at;
    at.p = position_;
    at.ng = {0, 0, 1};
    at.kind = PointKind::isolated;
    return {at, 1};
  }
  double pdf_position(const SurfacePoint&) const override { return 1; }
  Vec2 invert_position(const SurfacePoint&) const override { return Vec2(0.5); }

  bool delta() const override { return true; }

 protected:
  Vec3 position_{0};
};

}  // namespace mlt
