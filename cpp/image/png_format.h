// PNG, by libpng.
#pragma once

#include "base/atomic_file.h"
#include "image/decoded_image.h"

#include <functional>

namespace mlt {

/// Decodes samples of 8 or 16 bits, with alpha if the file has transparency. Throws a FileError
/// that begins with `name`.
DecodedImage decode_png(std::string_view bytes, const std::string& name);

/// Encodes interleaved 8-bit samples of 1 to 4 channels, row by row from `row(y)`.
void encode_png(AtomicFile& file, int width, int height, int channels,
                const std::function<const unsigned char*(int y)>& row);

}  // namespace mlt
