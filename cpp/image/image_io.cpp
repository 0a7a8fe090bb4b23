#include "image/image_io.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>

#include "base/atomic_file.h"
#include "image/jpeg_format.h"
#include "image/png_format.h"
#include "image/srgb.h"
#include "image/stb_formats.h"

namespace mlt {
namespace {

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

bool starts_with(std::string_view bytes, std::string_view magic) {
  return bytes.substr(0, magic.size()) == magic;
}

/// TGA has no magic number, so every field of its header that can be wrong is checked, and the
/// footer of version 2 (Truevision TGA File Format Specification 2.0, fields 2 to 5).
bool is_tga(std::string_view bytes) {
  constexpr std::string_view footer("TRUEVISION-XFILE.\0", 18);
  if (bytes.size() < 18) return false;
  if (bytes.substr(bytes.size() - footer.size()) == footer) return true;
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const int map = byte(1), type = byte(2), map_bits = byte(7), bits = byte(16);
  const bool mapped = type == 1 || type == 9, grey = type == 3 || type == 11;
  const bool color = type == 2 || type == 10;
  const auto is_one_of = [](int n, std::initializer_list<int> known) {
    return std::find(known.begin(), known.end(), n) != known.end();
  };
  if (mapped ? map != 1 || !is_one_of(map_bits, {15, 16, 24, 32}) : map > 1) return false;
  if (mapped || grey) return is_one_of(bits, {8, 16});
  return color && is_one_of(bits, {15, 16, 24, 32});
}

enum class Format { exr, png, jpeg, hdr, bmp, tga, unknown };

Format format_of(std::string_view bytes) {
  if (starts_with(bytes, "\x76\x2f\x31\x01")) return Format::exr;
  if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) return Format::png;
  if (starts_with(bytes, "\xff\xd8\xff")) return Format::jpeg;
  if (starts_with(bytes, "#?RADIANCE\n") || starts_with(bytes, "#?RGBE\n")) return Format::hdr;
  // "BM" could begin a TGA as well: its image ID would be 66 bytes long, of a colour-mapped
  // type 77.
  if (starts_with(bytes, "BM")) return Format::bmp;
  return is_tga(bytes) ? Format::tga : Format::unknown;
}

DecodedImage decode(std::string_view bytes, Format format, const std::string& name) {
  switch (format) {
    case Format::png: return decode_png(bytes, name);
    case Format::jpeg: return decode_jpeg(bytes, name);
    case Format::hdr: return decode_stb(bytes, StbFormat::hdr, name);
    case Format::bmp: return decode_stb(bytes, StbFormat::bmp, name);
    case Format::tga: return decode_stb(bytes, StbFormat::tga, name);
    default:
      throw FileError(name + (bytes.empty() ? ": the file is empty"
                                            : ": this is no image in a known format; use EXR, PNG, "
                                              "JPEG, HDR, TGA or BMP"));
  }
}

/// The byte floor(255 v + 1/2) of an encoded sample v; NaN becomes 0.
unsigned char to_byte(double v) {
  return static_cast<unsigned char>(v > 0 ? std::floor(255 * std::min(v, 1.0) + 0.5) : 0);
}

void check_channels(const std::string& path, const Image& image) {
  if (image.data.size() != Image::sample_count(image.width, image.height, image.channels))
    throw UsageError(path + ": the image's size differs from its data");
  if (image.channels > 4)
    throw UsageError(path + ": an image with " + std::to_string(image.channels) +
                     " channels can only be written as EXR, with names for them");
}

/// The rows of an image as bytes: colours brightened and encoded as sRGB.
class EncodedRows {
 public:
  EncodedRows(const Image& image, double exposure)
      : image_(image),
        scale_(std::exp2(exposure)),
        samples_(static_cast<size_t>(image.channels) * static_cast<size_t>(image.width)) {
    if (!(std::abs(exposure) <= max_exposure))
      throw UsageError(
          fmt::format("exposure is {}, but should lie between -128 and 128", exposure));
  }

  const unsigned char* operator()(int y) {
    const size_t channels = static_cast<size_t>(image_.channels);
    const size_t colours = channels - (channels % 2 == 0 ? 1 : 0);
    const float* from = &image_.data[static_cast<size_t>(y) * samples_.size()];
    for (size_t i = 0; i < samples_.size(); ++i)
      samples_[i] = to_byte(i % channels < colours ? linear_to_srgb(scale_ * from[i]) : from[i]);
    return samples_.data();
  }

 private:
  const Image& image_;
  double scale_;
  std::vector<unsigned char> samples_;
};

enum class Target { exr, png, jpeg, hdr };

Target target_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".exr") return Target::exr;
  if (extension == ".png") return Target::png;
  if (extension == ".jpg" || extension == ".jpeg") return Target::jpeg;
  if (extension == ".hdr") return Target::hdr;
  throw UsageError(path + ": cannot write an image with the extension '" + extension +
                   "'; valid are: .exr, .png, .jpg, .jpeg, .hdr");
}

}  // namespace

ReadImage read_image_memory(std::string_view bytes, const std::string& name,
                            const std::string& layer) {
  ReadImage read;
  const Format format = format_of(bytes);
  if (format == Format::exr) {
    read.image = decode_exr(bytes, name, layer);
  } else {
    DecodedImage decoded = decode(bytes, format, name);
    if (!layer.empty())
      throw FileError(name + ": has no layer '" + layer + "'; only EXR files have layers");
    read.image = std::move(decoded.image);
    read.bits = decoded.bits;
    read.srgb_encoded = decoded.bits < 32;
  }
  read.has_alpha = read.image.channels == 2 || read.image.channels == 4;
  return read;
}

ReadImage read_image(const std::string& path, const std::string& layer) {
  return read_image_memory(read_file(path), path, layer);
}

bool is_known_image(const std::string& path) {
  return format_of(read_file(path)) != Format::unknown;
}

Image linear_image(ReadImage read) {
  if (!read.srgb_encoded) return std::move(read.image);
  const double levels = (1 << read.bits) - 1;
  std::vector<float> table(size_t{1} << read.bits);
  for (size_t i = 0; i < table.size(); ++i)
    table[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / levels));
  const size_t channels = static_cast<size_t>(read.image.channels);
  const size_t colours = channels - (read.has_alpha ? 1 : 0);
  std::vector<float>& data = read.image.data;
  for (size_t i = 0; i < data.size(); ++i) {
    if (i % channels < colours) data[i] = table[static_cast<size_t>(std::lround(data[i] * levels))];
  }
  return std::move(read.image);
}

Metadata read_exr_metadata(const std::string& path) {
  return decode_exr_metadata(read_file(path), path);
}

void write_exr(const std::string& path, const std::vector<ExrLayer>& layers,
               const WriteOptions& options) {
  AtomicFile file(path);
  encode_exr(file, layers, options.half, options.metadata);
  file.commit();
}

void write_exr(const std::string& path, const Image& image, const WriteOptions& options) {
  write_exr(path, {ExrLayer{"", image}}, options);
}

void write_png(const std::string& path, const Image& image, double exposure) {
  check_channels(path, image);
  EncodedRows rows(image, exposure);
  AtomicFile file(path);
  encode_png(file, image.width, image.height, image.channels, std::ref(rows));
  file.commit();
}

std::string jpeg_of(const Image& image, double exposure) {
  EncodedRows rows(image, exposure);
  return encode_jpeg(image.width, image.height, image.channels, std::ref(rows));
}

void write_jpeg(const std::string& path, const Image& image, double exposure) {
  check_channels(path, image);
  write_file(path, jpeg_of(image, exposure));
}

void write_hdr(const std::string& path, const Image& image) {
  check_channels(path, image);
  write_file(path, encode_hdr(image));
}

void write_image(const std::string& path, const std::vector<ExrLayer>& layers,
                 const WriteOptions& options) {
  const Target target = target_of(path);
  if (layers.empty()) throw UsageError(path + ": there is no image to write");
  if (target == Target::exr) write_exr(path, layers, options);
  if (target == Target::png) write_png(path, layers.front().image, options.exposure);
  if (target == Target::jpeg) write_jpeg(path, layers.front().image, options.exposure);
  if (target == Target::hdr) write_hdr(path, layers.front().image);
}

void write_image(const std::string& path, const Image& image, const WriteOptions& options) {
  write_image(path, {ExrLayer{"", image}}, options);
}

bool has_straight_alpha(const std::string& path) { return target_of(path) == Target::png; }

std::string alpha_problem(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".exr" || extension == ".png") return "";
  return path + ": " + extension +
         " has no alpha, so the image is shown over black; use EXR or PNG";
}

void check_writable(const std::string& path) {
  target_of(path);
  check_file_writable(path);
}

}  // namespace mlt
