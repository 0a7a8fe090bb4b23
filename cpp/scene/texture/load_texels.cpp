#include "scene/texture/load_texels.h"

#include "image/image_io.h"
#include "image/srgb.h"

#include <cmath>

namespace mlt {
namespace {

/// Grey or RGB, without alpha and whatever comes after it.
Image colour_channels(Image image) {
  const int channels = image.channels < 3 ? 1 : 3;
  if (channels == image.channels) return image;
  Image kept(image.width, image.height, channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channels; ++c) kept.at(x, y, c) = image.at(x, y, c);
  return kept;
}

void decode(Image& image, const Decoding& decoding, bool srgb_encoded) {
  const bool srgb = decoding.kind == Decoding::Kind::srgb ||
                    (decoding.kind == Decoding::Kind::by_format && srgb_encoded);
  if (srgb) {
    for (float& v : image.data) v = static_cast<float>(srgb_to_linear(v));
  } else if (decoding.kind == Decoding::Kind::power) {
    for (float& v : image.data)
      v = static_cast<float>(std::copysign(std::pow(std::abs(double{v}), decoding.gamma), v));
  }
}

}  // namespace

Image load_texels(Params& params, const Decoding& decoding) {
  const std::string path = params.text("filename");
  ReadImage file = read_image(path);
  Image image = colour_channels(std::move(file.image));
  decode(image, decoding, file.srgb_encoded);
  bool negative = false;
  for (float& v : image.data) {
    if (!std::isfinite(v)) throw FileError(path + ": holds NaN or infinite pixels");
    if (v < 0 && !decoding.keep_negative) {
      v = 0;
      negative = true;
    }
  }
  if (negative) params.warn(path + ": negative values were set to 0");
  return image;
}

}  // namespace mlt
