// The elements that are values: numbers, strings, points, colours, spectra.
#pragma once

#include "base/schema.h"
#include "io/element.h"
#include "io/search_path.h"

#include <optional>
#include <string>

namespace mlt {

/// Is it <float>, <integer>, <boolean>, <string>, <point>, <vector>, <rgb>, <srgb> or <spectrum>?
bool is_value_tag(const std::string& tag);

/// The value of such an element. Throws SceneError.
Value read_value(const Element& element, const SearchPath& search);

/// x, y, z, or `value` with one number or three; `missing` stands for a coordinate not given.
Triple read_triple(const Element& element, double missing);

/// "0.5", "0.1 0.2 0.3", "#rrggbb" (always sRGB-encoded), or "400:0.1, 700:0.3".
std::optional<Value> parse_color(const std::string& text);

/// Samples (wavelength, value) from "400:0.1, 700:0.3": two or more, wavelengths increasing.
std::optional<Spectrum> parse_spectrum(const std::string& text);

/// What to write instead, for messages: "a number such as 0.5".
std::string example_of(const std::string& tag);

}  // namespace mlt
