// What the decoders of all formats share.
#pragma once

#include "image/image.h"
#include "image/validate.h"

#include <new>
#include <stdexcept>

namespace mlt {

struct DecodedImage {
  Image image;
  int bits = 8;  ///< 8 or 16: integers, scaled to [0, 1]; 32: linear radiance.
};

/// Throws std::runtime_error if a file of `file_size` bytes, each of which holds at most `per_byte`
/// pixels, is too small for an image of this size.
inline void check_size(int64_t width, int64_t height, int64_t per_byte, size_t file_size) {
  if (width <= 0 || height <= 0) throw std::runtime_error("its header says that it has no pixels");
  if (width > max_image_pixels / height ||
      width * height / per_byte > static_cast<int64_t>(file_size))
    throw std::runtime_error(too_many_pixels(width, height));
}

/// Calls `decode`; its errors become a FileError that names the file and the format.
template <class Decode>
DecodedImage decode_as(const char* format, const std::string& name, const Decode& decode) {
  const std::string what = name + ": cannot be read as " + format + ": ";
  try {
    return decode();
  } catch (const std::bad_alloc&) {
    throw FileError(what + "it needs more memory than there is");
  } catch (const std::exception& error) {
    throw FileError(what + error.what());
  }
}

}  // namespace mlt
