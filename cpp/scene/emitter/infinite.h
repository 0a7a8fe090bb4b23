// The common part of all lights at infinity. Their positions are directions (towards the light);
// their rays start on a disk outside of the scene, perpendicular to that direction and as large as
// the sphere around the scene (Veach 1997, sec. 8.3; Pharr et al., PBRT 3rd ed., sec. 16.1.2).
#pragma once

#include "math/frame.h"
#include "math/warp.h"
#include "scene/emitter/emitter.h"

namespace mlt {

class InfiniteEmitter : public Emitter {
 public:
  static SurfacePoint point_towards(const Vec3& w) {
    SurfacePoint at;
    at.p = w;
    at.ng = -w;
    at.kind = PointKind::infinite;
    return at;
  }

  /// Samples the disk uniformly: the density is 1 / (pi R^2).
  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    const Frame disk = Frame::around(x0.p);
    const Vec2 offset = sample_disk(u) * bounds_.radius;
    const Vec3 origin =
        bounds_.center + x0.p * bounds_.radius + disk.s * offset.x + disk.t * offset.y;
    return {origin, -x0.p, disk_density()};
  }
  double pdf_ray(const SurfacePoint&, const Vec3&) const override { return disk_density(); }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    const Vec3 local = Frame::around(x0.p).to_local(x1 - bounds_.center);
    return invert_disk(Vec2(local) / bounds_.radius);
  }

  bool infinite() const override { return true; }
  void set_bounds(const Bounds& bounds) override { bounds_ = bounds; }

 protected:
  double disk_area() const { return pi * sqr(bounds_.radius); }

 private:
  double disk_density() const { return 1 / disk_area(); }

  Bounds bounds_;
};

}  // namespace mlt
