// Embree 3 or 4, with the functions of the very library that we are linked with.
//
// Programs into which Python loads us may have an Embree of their own, as Blender has. The dynamic
// linker takes a function from the program's library first, even if that is another version, whose
// arguments differ. So each function is looked up in our own file and what that depends on.
#pragma once

#include <dlfcn.h>

#if MLT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace mlt {

/// The file that this code is in, a library or a program; nullptr if that is not known.
inline void* own_file() {
  static void* const file = [] {
    Dl_info here;
    return dladdr(reinterpret_cast<void*>(&own_file), &here)
               ? dlopen(here.dli_fname, RTLD_LAZY | RTLD_NOLOAD)
               : nullptr;
  }();
  return file;
}

/// The function `name` of our library; `linked`, which the dynamic linker has found, in a program.
template <class Function>
Function own_function(const char* name, Function linked) {
  void* const found = own_file() ? dlsym(own_file(), name) : nullptr;
  return found ? reinterpret_cast<Function>(found) : linked;
}

// Within our namespace these hide Embree's declarations.
#define MLT_OWN(name) inline const auto name = own_function(#name, &::name)
MLT_OWN(rtcAttachGeometryByID);
MLT_OWN(rtcCommitGeometry);
MLT_OWN(rtcCommitScene);
MLT_OWN(rtcGetDeviceError);
MLT_OWN(rtcIntersect1);
MLT_OWN(rtcIntersect8);
MLT_OWN(rtcNewDevice);
MLT_OWN(rtcNewGeometry);
MLT_OWN(rtcNewScene);
MLT_OWN(rtcOccluded1);
MLT_OWN(rtcOccluded8);
MLT_OWN(rtcReleaseDevice);
MLT_OWN(rtcReleaseGeometry);
MLT_OWN(rtcReleaseScene);
MLT_OWN(rtcSetGeometryBoundsFunction);
MLT_OWN(rtcSetGeometryInstancedScene);
MLT_OWN(rtcSetGeometryIntersectFunction);
MLT_OWN(rtcSetGeometryOccludedFilterFunction);
MLT_OWN(rtcSetGeometryOccludedFunction);
MLT_OWN(rtcSetGeometryTimeStepCount);
MLT_OWN(rtcSetGeometryTransform);
MLT_OWN(rtcSetGeometryUserData);
MLT_OWN(rtcSetGeometryUserPrimitiveCount);
MLT_OWN(rtcSetSceneBuildQuality);
MLT_OWN(rtcSetSharedGeometryBuffer);
#undef MLT_OWN

}  // namespace mlt
