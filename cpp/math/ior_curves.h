// Indices of refraction by name, as functions of the wavelength. Names are those of math/ior.h.
#pragma once

#include "math/curve.h"
#include "math/dispersion.h"

#include <optional>
#include <string>

namespace mlt {

/// The index of a named dielectric: a published dispersion formula where we have one, else the
/// constant of find_dielectric. The two may differ at the sodium line: `bk7` is 1.5046 in RGB, as
/// in Mitsuba, and 1.5167 here, as Schott makes it.
std::optional<RefractiveIndex> find_dispersive(const std::string& name);

/// The complex index of a named conductor as measured: pairs of (nm, value), in the visible range
/// or the part of it that was measured, and a pair on each side. Empty for "none".
struct ConductorTables {
  WavelengthTable eta, k;
};
std::optional<ConductorTables> find_conductor_tables(const std::string& name);

/// These tables as curves, which hold the values at the ends of the tables beyond these.
struct ConductorCurves {
  Curve eta, k;
};
std::optional<ConductorCurves> find_conductor_curves(const std::string& name);

}  // namespace mlt
