// Checks of image files that stb and OpenEXR leave out: without them a damaged or hostile file
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

/// Throws unless every chunk of a PNG file lies within the file, one of them is IEND, and the
/// checksums of the critical chunks are right (PNG 1.2, sec. 3).
void check_png_chunks(std::string_view bytes);

/// Throws if a Huffman table of a JPEG file defines more than 256 codes (ITU-T T.81, B.2.4.2). The
/// stb_image of Debian 12 (2.27) writes such a table past the end of its arrays.
void check_jpeg_tables(std::string_view bytes);

/// Throws unless every attribute in the headers of an EXR file lies within the file, and the file
/// is large enough for a table of all chunks that the headers announce (OpenEXR file layout,
/// "Header" and "Offset table"). OpenEXR 3.1 allocates both before it reads on.
void check_exr_headers(std::string_view bytes);

}  // namespace mlt
