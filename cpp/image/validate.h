// What stb and OpenEXR do not check by themselves before they believe a file from a stranger. All
// functions throw std::runtime_error with the reason.
#pragma once

#include <string_view>

namespace mlt {

/// PNG 1.2, sec. 3: chunks that end before the file does, with an IEND, and the checksums of those
/// that matter.
void check_png_chunks(std::string_view bytes);

/// JPEG (ITU-T T.81, B.2.4.2): no Huffman table may define more than 256 codes. The stb_image of
/// Debian 12 (2.27) writes such a table past the end of its arrays.
void check_jpeg_tables(std::string_view bytes);

/// OpenEXR file layout, "Header" and "Offset table": attributes that end before the file does, and
/// no more chunks than there is room for in the table that lists them. OpenEXR 3.1 allocates both
/// as a header tells it to.
void check_exr_headers(std::string_view bytes);

}  // namespace mlt
