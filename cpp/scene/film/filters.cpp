// The reconstruction filters, by the names and parameters that scenes use.
#include "base/registry.h"
#include "scene/film/film_settings.h"

namespace mlt {
namespace {

Plugin filter(const char* name, const char* doc, std::vector<Parameter> parameters,
              Filter (*make)(Params&)) {
  return {{"rfilter", name, doc, std::move(parameters)}, [make](Params& params) {
            auto object = std::make_shared<FilterObject>();
            object->filter = std::make_shared<const Filter>(make(params));
            return object;
          }};
}

}  // namespace

Plugin rfilter_box() {
  return filter("box", "Every sample counts in one pixel, the one it lies in.",
                {{"radius", ParamType::real, 0.5, "Half the width in pixels."}},
                [](Params& params) { return box_filter(params.real("radius")); });
}

Plugin rfilter_tent() {
  return filter("tent", "Falls linearly to 0.",
                {{"radius", ParamType::real, 1.0, "Half the width in pixels."}},
                [](Params& params) { return tent_filter(params.real("radius")); });
}

Plugin rfilter_gaussian() {
  return filter("gaussian", "A Gaussian, cut at 4 standard deviations.",
                {{"stddev", ParamType::real, 0.5, "Standard deviation in pixels."}},
                [](Params& params) { return gaussian_filter(params.real("stddev")); });
}

Plugin rfilter_mitchell() {
  return filter("mitchell", "The cubic filters of Mitchell and Netravali (1988).",
                {{"b", ParamType::real, 1.0 / 3, "Their parameter B."},
                 {"c", ParamType::real, 1.0 / 3, "Their parameter C."}},
                [](Params& params) { return mitchell_filter(params.real("b"), params.real("c")); });
}

Plugin rfilter_catmullrom() {
  return filter("catmullrom", "The mitchell filter with B = 0, C = 1/2, which is sharper.", {},
                [](Params&) { return catmullrom_filter(); });
}

Plugin rfilter_lanczos() {
  return filter(
      "lanczos", "A windowed sinc: the sharpest; it rings at edges.",
      {{"lobes", ParamType::integer, int64_t{3}, "Number of lobes, and the radius in pixels."}},
      [](Params& params) {
        return lanczos_filter(static_cast<int>(params.integer_in("lobes", 1, 16)));
      });
}

}  // namespace mlt
