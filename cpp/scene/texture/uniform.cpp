// Mitsuba's spectrum with one value at all wavelengths, or at those of a range.
#include "base/registry.h"
#include "scene/texture/spectrum_texture.h"

namespace mlt {
namespace {

constexpr double widest_wavelength = 1e6;

ObjectPtr make_uniform(Params& params) {
  const double value = params.real("value");
  if (value < 0) params.fail("value", fmt::format("is {}, but must not be negative", value));
  // In RGB it is grey, also as light, as in Mitsuba.
  if (!params.has("wavelength_min") && !params.has("wavelength_max"))
    return emitted_spectrum({{Color(value), RgbMeaning::coefficient}});
  const double low = params.real_in("wavelength_min", 0, widest_wavelength);
  const double high = params.real_in("wavelength_max", 0, widest_wavelength);
  return table_spectrum(params, "value", {{low, value}, {high, value}});
}

}  // namespace

Plugin texture_uniform() {
  return {{"texture",
           "uniform",
           "A spectrum with the same value at all wavelengths, grey in RGB.",
           {{"value", ParamType::real, 1.0, "The value."},
            {"wavelength_min", ParamType::real, first_wavelength,
             "The first wavelength in nm; below it, the spectrum is zero."},
            {"wavelength_max", ParamType::real, last_wavelength,
             "The last wavelength in nm; above it, the spectrum is zero."}}},
          make_uniform};
}

}  // namespace mlt
