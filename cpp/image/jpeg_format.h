// JPEG, by libjpeg-turbo.
#pragma once

#include "image/decoded_image.h"

#include <functional>
#include <string>

namespace mlt {

/// Decodes to grey or RGB. Throws a FileError that begins with `name`.
DecodedImage decode_jpeg(std::string_view bytes, const std::string& name);

/// Encodes 8-bit samples of 1 or 3 channels, row by row from `row(y)`, with the full resolution of
/// the colours. Throws a UsageError for another number, or more pixels than the format has.
std::string encode_jpeg(int width, int height, int channels,
                        const std::function<const unsigned char*(int y)>& row);

}  // namespace mlt
