// JPEG, by libjpeg-turbo.
#pragma once

#include "image/decoded_image.h"

namespace mlt {

/// Decodes to grey or RGB. Throws a FileError that begins with `name`.
DecodedImage decode_jpeg(std::string_view bytes, const std::string& name);

}  // namespace mlt
