// Rays and hits as Embree takes them, one or eight at a time.
#pragma once

#include "scene/accel/accel.h"
#include "scene/accel/embree_geometry.h"

#include <cmath>
#include <cstring>

namespace mlt {

inline void init(EmbreeQuery& query, const Ray* const* rays) {
#if MLT_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&query.base);
  rtcInitIntersectArguments(&query.intersect);
  rtcInitOccludedArguments(&query.occluded);
  query.intersect.context = query.occluded.context = &query.base;
#else
  rtcInitIntersectContext(&query.base);
#endif
  query.rays = rays;
}

/// Whether Embree takes a ray with these numbers of up to `most`; it ends the process for others,
/// which come from divisions by zero and from callbacks. Its t_max may be infinite, but not NaN.
inline bool is_castable(float ox, float oy, float oz, float dx, float dy, float dz, float t_max,
                        float most) {
  const float size = std::abs(ox) + std::abs(oy) + std::abs(oz) + std::abs(dx) + std::abs(dy) +
                     std::abs(dz);  // NaN if one of them is
  return (size <= most) & (t_max == t_max);
}

inline bool is_castable(const RTCRay& r, float most) {
  return is_castable(r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z, r.tfar, most);
}

inline RTCRay embree_ray(const Ray& ray) {
  RTCRay r;
  r.org_x = static_cast<float>(ray.o.x);
  r.org_y = static_cast<float>(ray.o.y);
  r.org_z = static_cast<float>(ray.o.z);
  r.dir_x = static_cast<float>(ray.d.x);
  r.dir_y = static_cast<float>(ray.d.y);
  r.dir_z = static_cast<float>(ray.d.z);
  r.tnear = 0;
  r.tfar = static_cast<float>(ray.t_max);
  r.time = 0;
  r.mask = ~0u;
  r.id = 0;
  r.flags = 0;
  return r;
}

inline Hit made_hit(float t, unsigned geometry, unsigned primitive, unsigned instance, float u,
                    float v) {
  return {t, instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance, primitive, u, v, geometry};
}

inline void unhit(RTCRayHit& ray) {
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

/// The lanes that are in use, and whose rays can be cast.
inline void fill_valid(const RayPacket& r, float most, int valid[RayPacket::size]) {
  for (int i = 0; i < RayPacket::size; ++i) {
    const bool castable =
        is_castable(r.ox[i], r.oy[i], r.oz[i], r.dx[i], r.dy[i], r.dz[i], r.t_max[i], most);
    valid[i] = -static_cast<int>((i < r.count) & castable);
  }
}

inline void fill(const RayPacket& packet, RTCRay8& rays) {
  constexpr size_t bytes = sizeof(packet.ox);
  std::memcpy(rays.org_x, packet.ox, bytes);
  std::memcpy(rays.org_y, packet.oy, bytes);
  std::memcpy(rays.org_z, packet.oz, bytes);
  std::memcpy(rays.dir_x, packet.dx, bytes);
  std::memcpy(rays.dir_y, packet.dy, bytes);
  std::memcpy(rays.dir_z, packet.dz, bytes);
  std::memcpy(rays.tfar, packet.t_max, bytes);
  for (int i = 0; i < RayPacket::size; ++i) {
    rays.tnear[i] = rays.time[i] = 0;
    rays.mask[i] = ~0u;
    rays.id[i] = i;
    rays.flags[i] = 0;
  }
}

}  // namespace mlt
