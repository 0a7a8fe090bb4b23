// The ray accelerator. accel.cpp is the only file that uses Embree.
#pragma once

#include "scene/placement.h"
#include "scene/ray.h"
#include "scene/shape.h"

#include <memory>
#include <vector>

namespace mlt {

/// Rays side by side, in single precision.
struct alignas(32) RayPacket {
  static constexpr int size = 8;
  float ox[size], oy[size], oz[size], dx[size], dy[size], dz[size], t_max[size];
  double time[size];
  int count = 0;

  void add(const Vec3f& o, const Vec3f& d, float most, double at) {
    ox[count] = o.x;
    oy[count] = o.y;
    oz[count] = o.z;
    dx[count] = d.x;
    dy[count] = d.y;
    dz[count] = d.z;
    time[count] = at;
    t_max[count++] = most;
  }
  void add(const Ray& ray) {
    add(Vec3f(ray.o), Vec3f(ray.d), static_cast<float>(ray.t_max), ray.time);
  }
  bool full() const { return count == size; }
};

class Accel {
 public:
  /// Builds the hierarchy; the result does not depend on `build_threads`.
  explicit Accel(const std::vector<ShapePtr>& shapes, const Shutter& shutter = {},
                 int build_threads = 1);
  ~Accel();

  /// Whether a hierarchy of these would be the same.
  bool serves(const std::vector<ShapePtr>& shapes, const Shutter& shutter) const;

  bool intersect(const Ray& ray, Hit& hit) const;
  bool occluded(const Ray& ray) const;

  /// The same of up to RayPacket::size rays; a hit on nothing has the shape SurfacePoint::no_shape.
  void intersect(const Ray* const* rays, int count, Hit* hits) const;
  /// Bit i is set if something is in the way of ray i.
  unsigned occluded(const RayPacket& packet) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mlt
