// Checks of image files that OpenEXR and others leave out: without them a damaged or hostile file
// could crash these libraries, or make them allocate far more memory than its pixels need. All
// functions throw std::runtime_error with the reason.
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace mlt {

inline std::string too_many_pixels(int64_t width, int64_t height) {
  return fmt::format(
      "its header says that it has {} x {} pixels, more than a file of this size can hold", width,
      height);
}

/// Throws unless every attribute in the headers of an EXR file lies within the file, and the file
/// is large enough for a table of all chunks that the headers announce (OpenEXR file layout,
/// "Header" and "Offset table"). OpenEXR 3.1 allocates both before it reads on.
void check_exr_headers(std::string_view bytes);

}  // namespace mlt
