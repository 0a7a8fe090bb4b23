// The reconstruction filters, by the names and parameters that scenes use.
#include "base/registry.h"
#include "scene/film_settings.h"

namespace mlt {
namespace {

/// Calls `make`, and says where in the scene the filter is when a parameter is out of range.
template <class Make>
ObjectPtr filter_object(Params& params, Make make) {
  try {
    auto object = std::make_shared<FilterObject>();
    object->filter = std::make_shared<const Filter>(make());
    return object;
  } catch (const SceneError& error) {
    throw SceneError(at(params.where(), error.what()));
  }
}

}  // namespace

Plugin rfilter_box() {
  return {{"rfilter",
           "box",
           "Every sample counts in one pixel, the one it lies in.",
           {{"radius", ParamType::real, 0.5, "Half the width in pixels."}}},
          [](Params& params) -> ObjectPtr {
            const double radius = params.real("radius");
            return filter_object(params, [&] { return box_filter(radius); });
          }};
}

Plugin rfilter_tent() {
  return {{"rfilter",
           "tent",
           "Falls linearly to 0.",
           {{"radius", ParamType::real, 1.0, "Half the width in pixels."}}},
          [](Params& params) -> ObjectPtr {
            const double radius = params.real("radius");
            return filter_object(params, [&] { return tent_filter(radius); });
          }};
}

Plugin rfilter_gaussian() {
  return {{"rfilter",
           "gaussian",
           "A Gaussian, cut at 4 standard deviations.",
           {{"stddev", ParamType::real, 0.5, "Standard deviation in pixels."}}},
          [](Params& params) -> ObjectPtr {
            const double stddev = params.real("stddev");
            return filter_object(params, [&] { return gaussian_filter(stddev); });
          }};
}

Plugin rfilter_mitchell() {
  return {{"rfilter",
           "mitchell",
           "The cubic filters of Mitchell and Netravali (1988).",
           {{"b", ParamType::real, 1.0 / 3, "Their parameter B."},
            {"c", ParamType::real, 1.0 / 3, "Their parameter C."}}},
          [](Params& params) -> ObjectPtr {
            const double b = params.real("b"), c = params.real("c");
            return filter_object(params, [&] { return mitchell_filter(b, c); });
          }};
}

Plugin rfilter_catmullrom() {
  return {
      {"rfilter", "catmullrom", "The mitchell filter with B = 0, C = 1/2, which is sharper.", {}},
      [](Params& params) -> ObjectPtr {
        return filter_object(params, [] { return catmullrom_filter(); });
      }};
}

Plugin rfilter_lanczos() {
  return {
      {"rfilter",
       "lanczos",
       "A windowed sinc: the sharpest; it rings at edges.",
       {{"lobes", ParamType::integer, int64_t{3}, "Number of lobes, and the radius in pixels."}}},
      [](Params& params) -> ObjectPtr {
        const int lobes = static_cast<int>(params.integer_in("lobes", 1, 16));
        return filter_object(params, [&] { return lanczos_filter(lobes); });
      }};
}

}  // namespace mlt
