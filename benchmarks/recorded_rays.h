// Stands between the library and Embree, to write down the rays that pass. Every ray of the library
// goes through two functions of Embree's shared library; a program that defines both gets the calls
// of everything linked into it. To be included once.
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

template <class Function>
Function embree_function(const char* name) {
  if (void* address = dlsym(RTLD_NEXT, name)) return reinterpret_cast<Function>(address);
  std::fprintf(stderr, "Embree has no %s; is it linked statically?\n", name);
  std::exit(3);
}

const auto embree_intersect = embree_function<decltype(&rtcIntersect1)>("rtcIntersect1");
const auto embree_occluded = embree_function<decltype(&rtcOccluded1)>("rtcOccluded1");

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
