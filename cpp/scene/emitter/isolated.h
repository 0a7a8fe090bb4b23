// The common part of all lights of no size: one position, which no walk can hit.
#pragma once

#include "scene/emitter/emitter.h"
#include "scene/transform/motion.h"

namespace mlt {

class IsolatedEmitter : public Emitter {
 public:
  explicit IsolatedEmitter(const Motion& motion)
      : motion_(motion), at_rest_(position(motion.steps()[0])) {}

  PositionSample sample_position(const Vec2&, double time) const override {
    SurfacePoint at;
    at.p = motion_.moves() ? position(motion_.at(time)) : at_rest_;
    at.ng = {0, 0, 1};
    at.kind = PointKind::isolated;
    at.time = time;
    return {at, 1};
  }
  double pdf_position(const SurfacePoint&) const override { return 1; }
  Vec2 invert_position(const SurfacePoint&) const override { return Vec2(0.5); }

  bool delta() const override { return true; }

 protected:
  Motion motion_;

 private:
  static Vec3 position(const Mat4& to_world) { return transform_point(to_world, Vec3(0)); }

  Vec3 at_rest_;
};

/// A light of no size whose intensity depends on the direction, about axes of its own. `axes_of`
/// finds these in its transform.
class TurnedEmitter : public IsolatedEmitter {
 public:
  using AxesOf = Frame (*)(const Mat4& to_world);
  TurnedEmitter(const Motion& motion, AxesOf axes_of)
      : IsolatedEmitter(motion), axes_of_(axes_of), at_rest_(axes_of(motion.steps()[0])) {}

 protected:
  Frame axes(double time) const { return motion_.moves() ? axes_of_(motion_.at(time)) : at_rest_; }

 private:
  AxesOf axes_of_;
  Frame at_rest_;
};

}  // namespace mlt
