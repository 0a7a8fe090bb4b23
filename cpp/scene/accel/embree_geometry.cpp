#include "scene/accel/embree_geometry.h"

#include <cmath>
#include <limits>
#include <optional>

namespace mlt {
namespace {

void analytic_bounds(const RTCBoundsFunctionArguments* args) {
  Vec3 low, high;
  static_cast<const AnalyticShape*>(args->geometryUserPtr)->bounds(low, high);
  const float inf = std::numeric_limits<float>::infinity();
  const auto down = [&](double x) { return std::nextafter(static_cast<float>(x), -inf); };
  const auto up = [&](double x) { return std::nextafter(static_cast<float>(x), inf); };
  *args->bounds_o = {down(low.x), down(low.y), down(low.z), 0,
                     up(high.x),  up(high.y),  up(high.z),  0};
}

/// Intersects lane i of the accelerator's rays with a shape. In an instance, or without the exact
/// ray, the accelerator's ray is used, whose direction has any length.
std::optional<double> analytic_hit(void* user_data, const EmbreeContext* context, RTCRayN* rays,
                                   unsigned lanes, unsigned i) {
  const auto& shape = *static_cast<const AnalyticShape*>(user_data);
  const float t_max = RTCRayN_tfar(rays, lanes, i);
  const EmbreeQuery& query = *reinterpret_cast<const EmbreeQuery*>(context);
  if (query.rays && context->instID[0] == RTC_INVALID_GEOMETRY_ID) {
    const Ray& ray = *query.rays[RTCRayN_id(rays, lanes, i)];
    return shape.intersect(ray.o, ray.d, 0, t_max);
  }
  const Vec3 o(RTCRayN_org_x(rays, lanes, i), RTCRayN_org_y(rays, lanes, i),
               RTCRayN_org_z(rays, lanes, i));
  const Vec3 d(RTCRayN_dir_x(rays, lanes, i), RTCRayN_dir_y(rays, lanes, i),
               RTCRayN_dir_z(rays, lanes, i));
  const double stretch = length(d);
  auto t = shape.intersect(o, d / stretch, 0, t_max * stretch);
  if (t) *t /= stretch;
  return t;
}

void analytic_intersect(const RTCIntersectFunctionNArguments* args) {
  RTCRayN* rays = RTCRayHitN_RayN(args->rayhit, args->N);
  RTCHitN* hits = RTCRayHitN_HitN(args->rayhit, args->N);
  for (unsigned i = 0; i < args->N; ++i) {
    if (!args->valid[i]) continue;
    const auto t = analytic_hit(args->geometryUserPtr, args->context, rays, args->N, i);
    if (!t) continue;
    RTCRayN_tfar(rays, args->N, i) = static_cast<float>(*t);
    RTCHitN_u(hits, args->N, i) = RTCHitN_v(hits, args->N, i) = 0;
    RTCHitN_geomID(hits, args->N, i) = args->geomID;
    RTCHitN_primID(hits, args->N, i) = args->primID;
    RTCHitN_instID(hits, args->N, i, 0) = args->context->instID[0];
  }
}

void analytic_occluded(const RTCOccludedFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i)
    if (args->valid[i] && analytic_hit(args->geometryUserPtr, args->context, args->ray, args->N, i))
      RTCRayN_tfar(args->ray, args->N, i) = -std::numeric_limits<float>::infinity();
}

}  // namespace

void analytic_passed(const RTCOccludedFunctionNArguments* args) {
  auto& query = *reinterpret_cast<EmbreeQuery*>(args->context);
  for (unsigned i = 0; i < args->N; ++i)
    if (args->valid[i] && analytic_hit(args->geometryUserPtr, args->context, args->ray, args->N, i))
      query.passed |= 1u << RTCRayN_id(args->ray, args->N, i);
}

void mesh_passed(const RTCFilterFunctionNArguments* args) {
  auto& query = *reinterpret_cast<EmbreeQuery*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    query.passed |= 1u << RTCRayN_id(args->ray, args->N, i);
    args->valid[i] = 0;
  }
}

RTCGeometry mesh_geometry(RTCDevice device, const Mesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const MeshData& data = mesh.data();
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                             data.positions.data(), 0, sizeof(Vec3f), data.positions.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             data.triangles.data(), 0, 3 * sizeof(uint32_t), data.triangles.size());
  return geometry;
}

RTCGeometry analytic_geometry(RTCDevice device, const AnalyticShape& shape) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, const_cast<AnalyticShape*>(&shape));
  rtcSetGeometryBoundsFunction(geometry, analytic_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, analytic_intersect);
  rtcSetGeometryOccludedFunction(geometry, analytic_occluded);
  return geometry;
}

}  // namespace mlt
