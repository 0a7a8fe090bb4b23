// Mitsuba's spectra of an RGB colour, which are linear in spite of the name of one: a reflectance
// that looks like the colour under D65, or that light.
#include "base/registry.h"
#include "scene/texture/spectrum_texture.h"

namespace mlt {
namespace {

ObjectPtr of_rgb(Params& params, const char* name, bool bounded) {
  const Color rgb = to_color(params, name, SpectrumUse::unbounded);
  if (min_component(rgb) < 0) params.fail(name, "must not be negative");
  if (bounded && max_component(rgb) > 1)
    params.fail(name, fmt::format("reaches {}, but must lie between 0 and 1, unless 'unbounded' is "
                                  "true",
                                  max_component(rgb)));
  return std::make_shared<SpectrumTexture>(
      [rgb](SpectrumUse use) { return UsedSpectrum{{rgb, meaning_of(use)}}; });
}

}  // namespace

Plugin texture_srgb() {
  return {{"texture",
           "srgb",
           "A smooth spectrum of a colour in linear RGB.",
           {{"color", ParamType::radiance, no_default, "The colour."},
            {"unbounded", ParamType::boolean, false, "Whether it may be larger than 1."}}},
          [](Params& params) { return of_rgb(params, "color", !params.boolean("unbounded")); }};
}

Plugin texture_rgb() {
  return {{"texture",
           "rgb",
           "A smooth spectrum of a colour in linear RGB, of any size.",
           {{"value", ParamType::radiance, no_default, "The colour."}}},
          [](Params& params) { return of_rgb(params, "value", false); }};
}

}  // namespace mlt
