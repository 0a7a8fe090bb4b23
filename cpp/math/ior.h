// Indices of refraction by name: dielectrics, and metals and other absorbing crystals as complex
// indices in linear sRGB. Names are those of Mitsuba.
#pragma once

#include "math/color.h"

#include <optional>
#include <string>
#include <vector>

namespace mlt {

/// The index of a named dielectric at 589 nm ("bk7", "water", "air", ...; case does not matter).
std::optional<double> find_dielectric(const std::string& name);
std::vector<std::string> dielectric_names();

struct ComplexIor {
  Color eta, k;
};

/// The complex index of a named conductor ("Au", "Cr", ...; "none" is a perfect mirror).
std::optional<ComplexIor> find_conductor(const std::string& name);
std::vector<std::string> conductor_names();

}  // namespace mlt
