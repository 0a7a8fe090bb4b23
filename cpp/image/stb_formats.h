// The formats that stb decodes and encodes: BMP, TGA and Radiance HDR. Everything works in memory;
// only the implementation of this header includes stb.
#pragma once

#include "image/decoded_image.h"

namespace mlt {

enum class StbFormat { bmp, tga, hdr };

/// Decodes a file. Throws a FileError that begins with `name`, also when a file ends early or is
/// too small for its size.
DecodedImage decode_stb(std::string_view bytes, StbFormat format, const std::string& name);

/// Encodes an image with 1 to 4 channels as Radiance RGBE. Values outside the format's range are
/// clamped: negative and NaN samples to 0, large ones to 1e38; alpha is dropped.
std::string encode_hdr(const Image& image);

}  // namespace mlt
