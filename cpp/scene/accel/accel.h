// The ray accelerator. accel.cpp is the only file that uses Embree.
#pragma once

#include "scene/accel/placement.h"
#include "scene/ray.h"
#include "scene/shape/shape.h"

#include <memory>
#include <vector>

namespace mlt {

/// Rays side by side, in single precision.
struct alignas(32) RayPacket {
  static constexpr int size = 8;
  float ox[size], oy[size], oz[size], dx[size], dy[size], dz[size], t_max[size];
  double time[size];
  int count;

  explicit RayPacket(int rays = 0) : count(rays) {}

  /// Sets origins and directions of all rays, from arrays of `size` numbers.
  void set_lines(const float* o_x, const float* o_y, const float* o_z, const float* d_x,
                 const float* d_y, const float* d_z) {
    for (int i = 0; i < size; ++i) {
      ox[i] = o_x[i];
      oy[i] = o_y[i];
      oz[i] = o_z[i];
      dx[i] = d_x[i];
      dy[i] = d_y[i];
      dz[i] = d_z[i];
    }
  }
  void set_endless() {
    for (float& most : t_max) most = std::numeric_limits<float>::infinity();
  }
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
};

/// The hits of a packet; for a ray that hits nothing, the shape is SurfacePoint::no_shape.
struct alignas(32) PacketHits {
  float t[RayPacket::size], u[RayPacket::size], v[RayPacket::size];
  uint32_t shape[RayPacket::size], primitive[RayPacket::size], member[RayPacket::size];

  Hit hit(int i) const { return {t[i], shape[i], primitive[i], u[i], v[i], member[i]}; }
};

/// What rays meet, one bit for each: surfaces that block them, and surfaces that light passes.
struct Occlusion {
  unsigned blocked = 0, passed = 0;
};

class Accel {
 public:
  /// Builds the hierarchy; the result does not depend on `build_threads`.
  explicit Accel(const std::vector<ShapePtr>& shapes, const Shutter& shutter = {},
                 int build_threads = 1);
  ~Accel();

  /// Whether the hierarchy of these shapes would be the same.
  bool fits(const std::vector<ShapePtr>& shapes, const Shutter& shutter) const;

  bool intersect(const Ray& ray, Hit& hit) const;
  /// Where a ray is blocked, it is not known what it would have passed.
  Occlusion occluded(const Ray& ray) const;

  /// Intersects up to RayPacket::size rays; `exact` has them in double precision, if
  /// wants_exact_rays(). Rays from one place in nearly one direction are `coherent`.
  void intersect(const RayPacket& packet, const Ray* const* exact, bool coherent,
                 PacketHits& hits) const;
  Occlusion occluded(const RayPacket& packet) const;

  /// Whether there are analytic shapes, which need rays in double precision.
  bool wants_exact_rays() const;
  /// Whether the time of a ray matters.
  bool moves() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mlt
