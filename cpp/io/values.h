// The elements that are values: numbers, strings, points, colours, spectra.
#pragma once

#include "base/schema.h"
#include "io/element.h"
#include "io/search_path.h"

#include <iosfwd>
#include <string>

namespace mlt {

/// Whether it is float, integer, boolean, string, point, vector, rgb, srgb or spectrum.
bool is_value_tag(const std::string& tag);

/// The value of an element that is a value. Throws SceneError.
Value read_value(const Element& element, const SearchPath& search);

/// What a file has: a wavelength and a value on each line; '#' begins a comment. Throws SceneError.
WavelengthTable read_spectrum_table(std::istream& file, const std::string& path);

/// x, y, z, or `value` with one number or three; `missing` stands for a coordinate not given.
Triple read_triple(const Element& element, double missing);

/// Parses the value of a parameter of this type ("8" for an integer, "true", ...), as
/// in `-p name=value`. Throws UsageError.
Value parse_value(const std::string& text, const Parameter& parameter);

}  // namespace mlt
