// Mitsuba's spectrum of values at equal steps of the wavelength.
#include "base/registry.h"
#include "scene/texture/spectrum_texture.h"

namespace mlt {
namespace {

ObjectPtr make_regular(Params& params) {
  const std::vector<double> values = numbers_param(params, "values");
  const double low = params.real("wavelength_min"), high = params.real("wavelength_max");
  if (values.size() < 2)
    params.fail("values", fmt::format("has {} numbers, but needs two or more", values.size()));
  if (high <= low)
    params.fail("wavelength_max", fmt::format("is {}, but must be above {}", high, low));
  WavelengthTable table;
  const double steps = static_cast<double>(values.size() - 1);
  for (size_t i = 0; i < values.size(); ++i)
    table.emplace_back(low + (high - low) * (static_cast<double>(i) / steps), values[i]);
  return table_spectrum(params, "values", table);
}

}  // namespace

Plugin texture_regular() {
  return {{"texture",
           "regular",
           "A spectrum of values at equal steps, linear between them and zero outside.",
           {{"wavelength_min", ParamType::real, first_wavelength, "The first wavelength, in nm."},
            {"wavelength_max", ParamType::real, last_wavelength, "The last wavelength, in nm."},
            {"values", ParamType::text, no_default, "Two or more numbers; a list in a dict."}}},
          make_regular};
}

}  // namespace mlt
