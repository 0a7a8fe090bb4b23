#include "scene/texture/load_texels.h"

#include "image/image_io.h"
#include "image/srgb.h"
#include "scene/texture/texture.h"
#include "scene/transform/transform_params.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mlt {
namespace {

/// The grey or RGB channels, without alpha and other channels.
Image colour_channels(Image image) {
  const int channels = image.channels < 3 ? 1 : 3;
  if (channels == image.channels) return image;
  Image kept(image.width, image.height, channels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < channels; ++c) kept.at(x, y, c) = image.at(x, y, c);
  return kept;
}

/// The linear value of a stored one.
double decoded(double v, const Decoding& decoding, bool srgb_encoded) {
  const bool srgb = decoding.kind == Decoding::Kind::srgb ||
                    (decoding.kind == Decoding::Kind::by_format && srgb_encoded);
  if (srgb) return srgb_to_linear(v);
  if (decoding.kind == Decoding::Kind::power)
    return std::copysign(std::pow(std::abs(v), decoding.gamma), v);
  return v;
}

/// The image that is in the scene in place of a file.
ReadImage held_image(Params& params) {
  if (params.has("filename")) params.fail("data", "and 'filename' exclude each other");
  const Buffer data = params.buffer("data");
  const std::string &bytes = data.bytes(), type = params.text("data_type");
  if (type == "file") return read_image_memory(bytes, "the image 'data'");
  const Vec3 shape = vector_param(params, "data_shape");
  const auto length = [&](int i) {
    return static_cast<int>(std::clamp(shape[i], 0.0, double{1 << 30}));
  };
  ReadImage held;
  held.image = Image(length(1), length(0), length(2));
  held.srgb_encoded = type == "uint8";
  held.bits = held.srgb_encoded ? 8 : 32;
  std::vector<float>& values = held.image.data;
  if (bytes.size() != values.size() * held.bits / 8)
    params.fail("data",
                "has another number of bytes than its shape says; give it as an array "
                "from Python");
  if (held.srgb_encoded)
    for (size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(static_cast<uint8_t>(bytes[i]) / 255.0);
  else
    std::memcpy(values.data(), bytes.data(), bytes.size());
  return held;
}

std::string name_of(Params& params) {
  return params.has("data") ? "the array 'data'" : params.text("filename");
}

ReadImage read_colours(Params& params) {
  ReadImage file = params.has("data") ? held_image(params) : read_image(params.text("filename"));
  file.image = colour_channels(std::move(file.image));
  return file;
}

Image decode_floats(Params& params, ReadImage&& file, const Decoding& decoding) {
  const std::string path = name_of(params);
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

std::vector<Parameter> image_parameters(const char* filename_doc) {
  return {{"filename", ParamType::text, no_default, filename_doc},
          {"data",
           ParamType::buffer,
           {},
           "In place of a file: an array, which a Python dict can give. (height, width), or with 1 "
           "to 4 channels; uint8 is sRGB, float32 is linear. Or the bytes of an image file."},
          {"data_shape", ParamType::point, no_default, "Height, width and channels of `data`."},
          choice_parameter("data_type", "float32", "Of `data`.", {"float32", "uint8", "file"})};
}

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
