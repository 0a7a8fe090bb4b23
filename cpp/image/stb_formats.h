// The formats that stb decodes and encodes: PNG, JPEG, BMP, TGA and Radiance HDR. Everything works
// on memory; the one translation unit behind this header is the only one that sees stb.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

namespace mlt {

enum class StbFormat { png, jpeg, bmp, tga, hdr };

struct StbImage {
  Image image;
  int bits = 8;  // 8 or 16: integers, scaled to [0, 1]; 32: linear radiance
};

/// Throws a FileError that begins with `name`, also when a file ends early or is too small for its
/// size.
StbImage decode_stb(std::string_view bytes, StbFormat format, const std::string& name);

/// 8-bit samples, interleaved, of 1 to 4 channels.
std::string encode_png(const std::vector<unsigned char>& samples, int width, int height,
                       int channels);

/// Radiance RGBE of an image with 1 to 4 channels. What the format cannot hold becomes the nearest
/// it can: negative and NaN samples 0, large ones 1e38; alpha is dropped.
std::string encode_hdr(const Image& image);

}  // namespace mlt
