// Stands between the library and Embree, to write down the rays that pass. Every ray of the library
// goes through four functions of Embree's shared library; a program that defines them gets the
// calls of everything linked into it. To be included once.
#pragma once

#if MLT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

struct RecordedRay {
  RTCRay ray;
  bool shadow;
};

struct Recording {
  RTCScene scene = nullptr;  ///< The one that the rays went to.
  std::vector<RecordedRay> rays;
};

/// Where this thread's rays are written down, or nullptr.
thread_local Recording* recording = nullptr;

void record(RTCScene scene, const RTCRay& ray, bool shadow) {
  recording->scene = scene;
  recording->rays.push_back({ray, shadow});
}

/// The rays of a packet, one by one.
void record(const int* valid, RTCScene scene, const RTCRay8& rays, bool shadow) {
  for (int i = 0; i < 8; ++i) {
    if (!valid[i]) continue;
    RTCRay ray = {};
    ray.org_x = rays.org_x[i];
    ray.org_y = rays.org_y[i];
    ray.org_z = rays.org_z[i];
    ray.dir_x = rays.dir_x[i];
    ray.dir_y = rays.dir_y[i];
    ray.dir_z = rays.dir_z[i];
    ray.tnear = rays.tnear[i];
    ray.tfar = rays.tfar[i];
    ray.time = rays.time[i];
    ray.mask = rays.mask[i];
    record(scene, ray, shadow);
  }
}

template <class Function>
Function embree_function(const char* name) {
  if (void* address = dlsym(RTLD_NEXT, name)) return reinterpret_cast<Function>(address);
  std::fprintf(stderr, "Embree has no %s; is it linked statically?\n", name);
  std::exit(3);
}

const auto embree_intersect = embree_function<decltype(&rtcIntersect1)>("rtcIntersect1");
const auto embree_occluded = embree_function<decltype(&rtcOccluded1)>("rtcOccluded1");
const auto embree_intersect8 = embree_function<decltype(&rtcIntersect8)>("rtcIntersect8");
const auto embree_occluded8 = embree_function<decltype(&rtcOccluded8)>("rtcOccluded8");

}  // namespace

#if MLT_EMBREE_MAJOR >= 4

void rtcIntersect1(RTCScene scene, RTCRayHit* rayhit, RTCIntersectArguments* arguments) {
  if (recording) record(scene, rayhit->ray, false);
  embree_intersect(scene, rayhit, arguments);
}
void rtcOccluded1(RTCScene scene, RTCRay* ray, RTCOccludedArguments* arguments) {
  if (recording) record(scene, *ray, true);
  embree_occluded(scene, ray, arguments);
}
void rtcIntersect8(const int* valid, RTCScene scene, RTCRayHit8* rayhit,
                   RTCIntersectArguments* arguments) {
  if (recording) record(valid, scene, rayhit->ray, false);
  embree_intersect8(valid, scene, rayhit, arguments);
}
void rtcOccluded8(const int* valid, RTCScene scene, RTCRay8* ray, RTCOccludedArguments* arguments) {
  if (recording) record(valid, scene, *ray, true);
  embree_occluded8(valid, scene, ray, arguments);
}
inline void bare_intersect(RTCScene scene, RTCRayHit& rayhit) {
  embree_intersect(scene, &rayhit, nullptr);
}
inline void bare_occluded(RTCScene scene, RTCRay& ray) { embree_occluded(scene, &ray, nullptr); }

#else

void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* rayhit) {
  if (recording) record(scene, rayhit->ray, false);
  embree_intersect(scene, context, rayhit);
}
void rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  if (recording) record(scene, *ray, true);
  embree_occluded(scene, context, ray);
}
void rtcIntersect8(const int* valid, RTCScene scene, RTCIntersectContext* context,
                   RTCRayHit8* rayhit) {
  if (recording) record(valid, scene, rayhit->ray, false);
  embree_intersect8(valid, scene, context, rayhit);
}
void rtcOccluded8(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRay8* ray) {
  if (recording) record(valid, scene, *ray, true);
  embree_occluded8(valid, scene, context, ray);
}
inline void bare_intersect(RTCScene scene, RTCRayHit& rayhit) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  embree_intersect(scene, &context, &rayhit);
}
inline void bare_occluded(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  embree_occluded(scene, &context, &ray);
}

#endif

/// Traces the recorded rays. Which ray comes next depends on the hit before it (in truth it never
/// does), as in any walk: without that the processor would overlap rays that no renderer can
/// overlap.
inline uint64_t replay(const Recording& recorded) {
  uint64_t hits = 0;
  for (size_t i = 0; i < recorded.rays.size();) {
    const RecordedRay& r = recorded.rays[i];
    if (r.shadow) {
      RTCRay ray = r.ray;
      bare_occluded(recorded.scene, ray);
      hits += ray.tfar < 0;
      i += 1;
    } else {
      RTCRayHit rayhit;
      rayhit.ray = r.ray;
      rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rayhit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      bare_intersect(recorded.scene, rayhit);
      hits += rayhit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
      i += 1 + (rayhit.hit.geomID == RTC_INVALID_GEOMETRY_ID - 1);
    }
  }
  return hits;
}
