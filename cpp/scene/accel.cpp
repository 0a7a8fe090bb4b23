// The ray accelerator on Embree 3 or 4. Meshes go to Embree as they are; analytic shapes are
// user geometry, intersected in double precision with the ray as it was given. Groups of shapes are
// scenes of their own, of which there are instances. What moves is an instance whose transform is
// linear between steps of time, by Embree's own interpolation.
#include "scene/accel.h"

#include "scene/analytic_shape.h"
#include "scene/instance.h"
#include "scene/mesh.h"

#if MLT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <map>
#include <string>

namespace mlt {
namespace {

#if MLT_EMBREE_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// The context of a query, with the ray in double precision for the analytic shapes.
struct Query {
  Context base;
  const Ray* ray;
};

void init(Query& query, const Ray& ray) {
#if MLT_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&query.base);
#else
  rtcInitIntersectContext(&query.base);
#endif
  query.ray = &ray;
}

RTCRay embree_ray(const Ray& ray) {
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

void analytic_bounds(const RTCBoundsFunctionArguments* args) {
  Vec3 low, high;
  static_cast<const AnalyticShape*>(args->geometryUserPtr)->bounds(low, high);
  const float inf = std::numeric_limits<float>::infinity();
  const auto down = [&](double x) { return std::nextafter(static_cast<float>(x), -inf); };
  const auto up = [&](double x) { return std::nextafter(static_cast<float>(x), inf); };
  *args->bounds_o = {down(low.x), down(low.y), down(low.z), 0,
                     up(high.x),  up(high.y),  up(high.z),  0};
}

/// In an instance the ray is the accelerator's, whose direction has any length.
std::optional<double> analytic_hit(void* user_data, const Context* context, const RTCRay& moved) {
  const auto& shape = *static_cast<const AnalyticShape*>(user_data);
  if (context->instID[0] == RTC_INVALID_GEOMETRY_ID) {
    const Ray& ray = *reinterpret_cast<const Query*>(context)->ray;
    return shape.intersect(ray.o, ray.d, 0, moved.tfar);
  }
  const Vec3 d(moved.dir_x, moved.dir_y, moved.dir_z);
  const double stretch = length(d);
  auto t = shape.intersect({moved.org_x, moved.org_y, moved.org_z}, d / stretch, 0,
                           moved.tfar * stretch);
  if (t) *t /= stretch;
  return t;
}

void analytic_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  RTCRayHit& rayhit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto t = analytic_hit(args->geometryUserPtr, args->context, rayhit.ray);
  if (!t) return;
  rayhit.ray.tfar = static_cast<float>(*t);
  rayhit.hit.u = rayhit.hit.v = 0;
  rayhit.hit.geomID = args->geomID;
  rayhit.hit.primID = args->primID;
  rayhit.hit.instID[0] = args->context->instID[0];
}

void analytic_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  RTCRay& ray = *reinterpret_cast<RTCRay*>(args->ray);
  if (analytic_hit(args->geometryUserPtr, args->context, ray))
    ray.tfar = -std::numeric_limits<float>::infinity();
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

/// Of address space: what Embree and its threads take at the least.
constexpr size_t least_memory = size_t{128} << 20;

bool can_allocate(size_t bytes) {
  void* start = std::malloc(bytes);
  std::free(start);
  return start != nullptr;
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

bool moves(const ShapePtr& shape) {
  const Instance* instance = shape->as_instance();
  return instance && instance->motion().moves();
}

/// The device's error in words, or ""; without a device, why there is none. Where memory is short
/// Embree often fails before it can say so; then it is a thread or a library that it lacks.
std::string why_not(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (device && error == RTC_ERROR_NONE) return "";
  if (error == RTC_ERROR_OUT_OF_MEMORY || !can_allocate(least_memory))
    return "there is not memory enough for Embree";
  return std::string("Embree ") + what;
}

}  // namespace

struct Accel::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  bool moves = false;
  Shutter shutter;
  std::map<const ShapeGroup*, RTCScene> groups;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    for (const auto& [group, built] : groups) rtcReleaseScene(built);
    if (device) rtcReleaseDevice(device);
  }

  RTCScene build(const std::vector<ShapePtr>& shapes);
  RTCGeometry geometry(const Shape& shape);
  RTCGeometry instance_geometry(const Instance& instance);

  /// In [0, 1], also of what is no number.
  float embree_time(double time) const {
    const double share = (time - shutter.open) / (shutter.close - shutter.open);
    return static_cast<float>(std::min(std::max(0.0, share), 1.0));
  }
};

RTCScene Accel::Impl::build(const std::vector<ShapePtr>& shapes) {
  RTCScene built = rtcNewScene(device);
  rtcSetSceneBuildQuality(built, RTC_BUILD_QUALITY_MEDIUM);
  for (size_t i = 0; i < shapes.size(); ++i) {
    RTCGeometry made = geometry(*shapes[i]);
    rtcCommitGeometry(made);
    rtcAttachGeometryByID(built, made, static_cast<unsigned>(i));
    rtcReleaseGeometry(made);
  }
  rtcCommitScene(built);
  return built;
}

RTCGeometry Accel::Impl::geometry(const Shape& shape) {
  if (const Mesh* mesh = shape.as_mesh()) return mesh_geometry(device, *mesh);
  if (const Instance* instance = shape.as_instance()) return instance_geometry(*instance);
  return analytic_geometry(device, *shape.as_analytic());
}

RTCGeometry Accel::Impl::instance_geometry(const Instance& instance) {
  RTCScene& group = groups[&instance.group()];
  if (!group) group = build(instance.group().shapes());
  RTCGeometry made = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(made, group);
  const std::vector<Mat4>& steps = instance.motion().steps();
  rtcSetGeometryTimeStepCount(made, static_cast<unsigned>(steps.size()));
  for (unsigned i = 0; i < steps.size(); ++i) {
    const glm::mat4 to_world(steps[i]);
    rtcSetGeometryTransform(made, i, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &to_world);
  }
  return made;
}

Accel::Accel(const std::vector<ShapePtr>& shapes, const Shutter& shutter, int build_threads)
    : impl_(std::make_unique<Impl>()) {
  impl_->moves = std::any_of(shapes.begin(), shapes.end(), moves);
  impl_->shutter = shutter;
  // A fixed instruction set, so that the bits do not depend on the machine's vector width.
  const std::string config = "max_isa=avx2,threads=" + std::to_string(build_threads);
  impl_->device = rtcNewDevice(config.c_str());
  if (!impl_->device) throw RenderError(why_not(nullptr, "does not start on this machine"));
  impl_->scene = impl_->build(shapes);
  const std::string problem = why_not(impl_->device, "could not build the acceleration structure");
  if (!problem.empty()) throw RenderError(problem);
}

Accel::~Accel() = default;

bool Accel::intersect(const Ray& ray, Hit& hit) const {
  Query query;
  init(query, ray);
  RTCRayHit rayhit;
  rayhit.ray = embree_ray(ray);
  if (impl_->moves) rayhit.ray.time = impl_->embree_time(ray.time);
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rayhit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if MLT_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &query.base;
  rtcIntersect1(impl_->scene, &rayhit, &arguments);
#else
  rtcIntersect1(impl_->scene, &query.base, &rayhit);
#endif
  if (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  const unsigned instance = rayhit.hit.instID[0], geometry = rayhit.hit.geomID;
  hit = {rayhit.ray.tfar,   instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance,
         rayhit.hit.primID, rayhit.hit.u,
         rayhit.hit.v,      geometry};
  return true;
}

bool Accel::occluded(const Ray& ray) const {
  Query query;
  init(query, ray);
  RTCRay r = embree_ray(ray);
  if (impl_->moves) r.time = impl_->embree_time(ray.time);
#if MLT_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &query.base;
  rtcOccluded1(impl_->scene, &r, &arguments);
#else
  rtcOccluded1(impl_->scene, &query.base, &r);
#endif
  return r.tfar < 0;
}

}  // namespace mlt
