// Mitsuba's spectrum of values at any wavelengths.
#include "base/registry.h"
#include "scene/texture/spectrum_texture.h"

namespace mlt {
namespace {

ObjectPtr make_irregular(Params& params) {
  const std::vector<double> wavelengths = numbers_param(params, "wavelengths");
  const std::vector<double> values = numbers_param(params, "values");
  if (values.size() != wavelengths.size())
    params.fail("values", fmt::format("has {} numbers, but there are {} wavelengths", values.size(),
                                      wavelengths.size()));
  WavelengthTable table;
  for (size_t i = 0; i < values.size(); ++i) table.emplace_back(wavelengths[i], values[i]);
  return table_spectrum(params, "values", table);
}

}  // namespace

Plugin texture_irregular() {
  return {{"texture",
           "irregular",
           "A spectrum of values at any wavelengths, linear between them and zero outside.",
           {{"wavelengths", ParamType::text, no_default,
             "Two or more wavelengths in nm, in increasing order; a list in a dict."},
            {"values", ParamType::text, no_default, "A number for each; a list in a dict."}}},
          make_irregular};
}

}  // namespace mlt
