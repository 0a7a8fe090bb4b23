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

/// What a stored value means.
double decoded(double v, const Decoding& decoding, bool srgb_encoded) {
  const bool srgb = decoding.kind == Decoding::Kind::srgb ||
                    (decoding.kind == Decoding::Kind::by_format && srgb_encoded);
  if (srgb) return srgb_to_linear(v);
  if (decoding.kind == Decoding::Kind::power)
    return std::copysign(std::pow(std::abs(v), decoding.gamma), v);
  return v;
}

ReadImage read_colours(Params& params) {
  ReadImage file = read_image(params.text("filename"));
  file.image = colour_channels(std::move(file.image));
  return file;
}

Image decode_floats(Params& params, ReadImage&& file, const Decoding& decoding) {
  const std::string path = params.text("filename");
  bool negative = false;
  for (float& v : file.image.data) {
    v = static_cast<float>(decoded(v, decoding, file.srgb_encoded));
    if (!std::isfinite(v)) throw FileError(path + ": holds NaN or infinite pixels");
    if (v < 0 && !decoding.keep_negative) {
      v = 0;
      negative = true;
    }
  }
  if (negative) params.warn(path + ": negative values were set to 0");
  return std::move(file.image);
}

}  // namespace

Image load_image(Params& params, const Decoding& decoding) {
  return decode_floats(params, read_colours(params), decoding);
}

Texels load_texels(Params& params, const Decoding& decoding) {
  ReadImage file = read_colours(params);
  if (file.bits != 8) return Texels(decode_floats(params, std::move(file), decoding));
  Texels::Meaning meaning;
  for (size_t i = 0; i < meaning.size(); ++i)
    meaning[i] =
        static_cast<float>(decoded(static_cast<float>(i / 255.0), decoding, file.srgb_encoded));
  return {file.image, meaning};
}

}  // namespace mlt
