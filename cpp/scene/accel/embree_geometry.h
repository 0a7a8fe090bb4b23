// Shapes as geometry of Embree: meshes are passed to it directly, analytic shapes are user
// geometry, intersected in double precision with the original ray.
#pragma once

#include "scene/accel/embree.h"
#include "scene/mesh/mesh.h"
#include "scene/shape/analytic_shape.h"

namespace mlt {

#if MLT_EMBREE_MAJOR >= 4
using EmbreeContext = RTCRayQueryContext;
constexpr auto coherent_flag = RTC_RAY_QUERY_FLAG_COHERENT;
#else
using EmbreeContext = RTCIntersectContext;
constexpr auto coherent_flag = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
#endif

/// The context of a query, with the rays in double precision for the analytic shapes, if there are
/// any; a ray of the accelerator refers to one by its `id`.
struct EmbreeQuery {
  EmbreeContext base;
  const Ray* const* rays;
  unsigned passed = 0;  ///< See Occlusion.
#if MLT_EMBREE_MAJOR >= 4
  RTCIntersectArguments intersect;
  RTCOccludedArguments occluded;
#endif
};

RTCGeometry mesh_geometry(RTCDevice device, const Mesh& mesh);
RTCGeometry analytic_geometry(RTCDevice device, const AnalyticShape& shape);

/// Lets light through an analytic shape, and remembers the rays that meet it.
void analytic_passed(const RTCOccludedFunctionNArguments* args);
/// Lets light through a mesh, and remembers the rays that meet it.
void mesh_passed(const RTCFilterFunctionNArguments* args);

}  // namespace mlt
