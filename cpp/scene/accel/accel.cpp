// The ray accelerator on Embree 3 or 4. Meshes are passed to Embree directly; analytic shapes are
// user geometry, intersected in double precision with the original ray. Groups of shapes are
// scenes of their own, of which there are instances. A moving shape is an instance whose transform
// is linear between steps of time, by Embree's own interpolation.
#include "scene/accel/accel.h"

#include "scene/accel/embree_geometry.h"
#include "scene/accel/embree_rays.h"
#include "scene/accel/instance.h"

#include <algorithm>
#include <string>

namespace mlt {
namespace {

static_assert(SurfacePoint::no_shape == RTC_INVALID_GEOMETRY_ID);

/// Bytes of address space that Embree and its threads take at the least.
constexpr size_t least_memory = size_t{128} << 20;

bool can_allocate(size_t bytes) {
  void* start = std::malloc(bytes);
  std::free(start);
  return start != nullptr;
}

/// The device's error in words, or ""; without a device, why there is none. If memory is short
/// Embree often fails without reporting that, for want of a thread or a library.
std::string why_not(RTCDevice device, const char* what) {
  const RTCError error = rtcGetDeviceError(device);
  if (device && error == RTC_ERROR_NONE) return "";
  if (error == RTC_ERROR_OUT_OF_MEMORY || !can_allocate(least_memory))
    return "out of memory for Embree";
  return std::string("Embree ") + what;
}

}  // namespace

struct Accel::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  bool moves = false;
  bool analytic = false;  ///< Whether there are analytic shapes outside groups.
  float most = 1e18f;     ///< Bound of rays, such that instances have them below Embree's.
  Shutter shutter;
  Placements placements;  ///< Embree reads the buffers of their forms.
  std::vector<RTCScene> groups;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    for (RTCScene group : groups) rtcReleaseScene(group);
    if (device) rtcReleaseDevice(device);
  }

  void build();
  template <class Elements, class MakeGeometry>
  RTCScene build(const Elements& elements, const MakeGeometry& make);
  RTCGeometry form_geometry(const PlacedForm& form) const;
  RTCGeometry instance_geometry(const Placement& instance) const;

  /// The time of a ray in [0, 1]; 0 for NaN.
  float embree_time(double time) const {
    const double share = (time - shutter.open) / (shutter.close - shutter.open);
    return static_cast<float>(std::min(std::max(0.0, share), 1.0));
  }
  void set_times(const RayPacket& packet, RTCRay8& rays) const {
    if (!moves) return;
    for (int i = 0; i < packet.count; ++i) rays.time[i] = embree_time(packet.time[i]);
  }
};

template <class Elements, class MakeGeometry>
RTCScene Accel::Impl::build(const Elements& elements, const MakeGeometry& make) {
  RTCScene built = rtcNewScene(device);
  rtcSetSceneBuildQuality(built, RTC_BUILD_QUALITY_MEDIUM);
  for (size_t i = 0; i < elements.size(); ++i) {
    RTCGeometry made = make(elements[i]);
    rtcCommitGeometry(made);
    rtcAttachGeometryByID(built, made, static_cast<unsigned>(i));
    rtcReleaseGeometry(made);
  }
  rtcCommitScene(built);
  return built;
}

void Accel::Impl::build() {
  for (const auto& group : placements.groups)
    groups.push_back(build(group, [&](const PlacedForm& form) { return form_geometry(form); }));
  scene = build(placements.all, [&](const Placement& placed) {
    return placed.form.shape ? form_geometry(placed.form) : instance_geometry(placed);
  });
}

RTCGeometry Accel::Impl::form_geometry(const PlacedForm& form) const {
  const Mesh* mesh = form.shape->as_mesh();
  const RTCGeometry made =
      mesh ? mesh_geometry(device, *mesh) : analytic_geometry(device, *form.shape->as_analytic());
  if (!form.has_passage) return made;
  if (mesh)
    rtcSetGeometryOccludedFilterFunction(made, mesh_passed);
  else
    rtcSetGeometryOccludedFunction(made, analytic_passed);
  return made;
}

RTCGeometry Accel::Impl::instance_geometry(const Placement& instance) const {
  RTCGeometry made = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(made, groups[instance.group]);
  const std::vector<Mat4>& steps = instance.steps;
  rtcSetGeometryTimeStepCount(made, static_cast<unsigned>(steps.size()));
  for (unsigned i = 0; i < steps.size(); ++i) {
    const glm::mat4 to_world(steps[i]);
    rtcSetGeometryTransform(made, i, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &to_world);
  }
  return made;
}

Accel::Accel(const std::vector<ShapePtr>& shapes, const Shutter& shutter, int build_threads)
    : impl_(std::make_unique<Impl>()) {
  impl_->placements = Placements(shapes);
  impl_->moves = impl_->placements.moves();
  for (const Placement& placed : impl_->placements.all) {
    impl_->analytic |= placed.form.shape && placed.form.shape->as_analytic();
    for (const Mat4& step : placed.steps)
      impl_->most = std::min(impl_->most, float(1e18 * AffineMap(step).least_scale()));
  }
  impl_->shutter = shutter;
  // A fixed instruction set, so that the bits do not depend on the machine's vector width.
  const std::string config = "max_isa=avx2,threads=" + std::to_string(build_threads);
  impl_->device = rtcNewDevice(config.c_str());
  if (!impl_->device) throw RenderError(why_not(nullptr, "does not start on this machine"));
  impl_->build();
  const std::string problem = why_not(impl_->device, "could not build the acceleration structure");
  if (!problem.empty()) throw RenderError(problem);
}

Accel::~Accel() = default;

bool Accel::fits(const std::vector<ShapePtr>& shapes, const Shutter& shutter) const {
  const bool same_times = !impl_->moves || (shutter.open == impl_->shutter.open &&
                                            shutter.close == impl_->shutter.close);
  return same_times && Placements(shapes) == impl_->placements;
}

bool Accel::intersect(const Ray& ray, Hit& hit) const {
  const Ray* rays = &ray;
  EmbreeQuery query;
  init(query, &rays);
  RTCRayHit rayhit;
  rayhit.ray = embree_ray(ray);
  if (!is_castable(rayhit.ray, impl_->most)) return false;
  if (impl_->moves) rayhit.ray.time = impl_->embree_time(ray.time);
  unhit(rayhit);
#if MLT_EMBREE_MAJOR >= 4
  rtcIntersect1(impl_->scene, &rayhit, &query.intersect);
#else
  rtcIntersect1(impl_->scene, &query.base, &rayhit);
#endif
  if (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  hit = made_hit(rayhit.ray.tfar, rayhit.hit.geomID, rayhit.hit.primID, rayhit.hit.instID[0],
                 rayhit.hit.u, rayhit.hit.v);
  return true;
}

Occlusion Accel::occluded(const Ray& ray) const {
  const Ray* rays = &ray;
  EmbreeQuery query;
  init(query, &rays);
  RTCRay r = embree_ray(ray);
  if (!is_castable(r, impl_->most)) return {1, 0};
  if (impl_->moves) r.time = impl_->embree_time(ray.time);
#if MLT_EMBREE_MAJOR >= 4
  rtcOccluded1(impl_->scene, &r, &query.occluded);
#else
  rtcOccluded1(impl_->scene, &query.base, &r);
#endif
  return {r.tfar < 0, query.passed};
}

void Accel::intersect(const RayPacket& packet, const Ray* const* exact, bool coherent,
                      PacketHits& hits) const {
  EmbreeQuery query;
  init(query, exact);
  alignas(32) int valid[RayPacket::size];
  fill_valid(packet, impl_->most, valid);
  RTCRayHit8 rayhit;
  fill(packet, rayhit.ray);
  impl_->set_times(packet, rayhit.ray);
  for (int i = 0; i < RayPacket::size; ++i)
    rayhit.hit.geomID[i] = rayhit.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
#if MLT_EMBREE_MAJOR >= 4
  if (coherent) query.intersect.flags = coherent_flag;
  rtcIntersect8(valid, impl_->scene, &rayhit, &query.intersect);
#else
  if (coherent) query.base.flags = coherent_flag;
  rtcIntersect8(valid, impl_->scene, &query.base, &rayhit);
#endif
  for (int i = 0; i < RayPacket::size; ++i) {
    const unsigned geometry = rayhit.hit.geomID[i], instance = rayhit.hit.instID[0][i];
    hits.shape[i] = instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance;
    hits.member[i] = geometry;
    hits.primitive[i] = rayhit.hit.primID[i];
    hits.t[i] = rayhit.ray.tfar[i];
    hits.u[i] = rayhit.hit.u[i];
    hits.v[i] = rayhit.hit.v[i];
  }
}

bool Accel::wants_exact_rays() const { return impl_->analytic; }
bool Accel::moves() const { return impl_->moves; }

Occlusion Accel::occluded(const RayPacket& packet) const {
  EmbreeQuery query;
  init(query, nullptr);
  alignas(32) int valid[RayPacket::size];
  fill_valid(packet, impl_->most, valid);
  RTCRay8 rays;
  fill(packet, rays);
  impl_->set_times(packet, rays);
#if MLT_EMBREE_MAJOR >= 4
  rtcOccluded8(valid, impl_->scene, &rays, &query.occluded);
#else
  rtcOccluded8(valid, impl_->scene, &query.base, &rays);
#endif
  Occlusion found{0, query.passed};
  for (int i = 0; i < packet.count; ++i) {
    const unsigned blocked = (rays.tfar[i] < 0) | !valid[i];
    found.blocked |= blocked << i;
  }
  return found;
}

}  // namespace mlt
