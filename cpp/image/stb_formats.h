// The formats that stb decodes and encodes: BMP, TGA and Radiance HDR. Everything works on memory;
// the one translation unit behind this header is the only one that sees stb.
#pragma once

#include "image/decoded_image.h"

namespace mlt {

enum class StbFormat { bmp, tga, hdr };

/// Throws a FileError that begins with `name`, also when a file ends early or is too small for its
/// size.
DecodedImage decode_stb(std::string_view bytes, StbFormat format, const std::string& name);

/// Radiance RGBE of an image with 1 to 4 channels. What the format cannot hold becomes the nearest
/// it can: negative and NaN samples 0, large ones 1e38; alpha is dropped.
std::string encode_hdr(const Image& image);

}  // namespace mlt
