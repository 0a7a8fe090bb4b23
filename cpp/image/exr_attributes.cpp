#include "image/exr_attributes.h"

#include <map>
#include <stdexcept>
#include <string>

namespace mlt {
namespace {

/// Bytes of the types with a fixed size.
const std::map<std::string_view, size_t>& fixed_sizes() {
  static const std::map<std::string_view, size_t> sizes{{"box2i", 16},
                                                        {"box2f", 16},
                                                        {"chromaticities", 32},
                                                        {"compression", 1},
                                                        {"deepImageState", 1},
                                                        {"double", 8},
                                                        {"envmap", 1},
                                                        {"float", 4},
                                                        {"int", 4},
                                                        {"keycode", 28},
                                                        {"lineOrder", 1},
                                                        {"m33f", 36},
                                                        {"m33d", 72},
                                                        {"m44f", 64},
                                                        {"m44d", 128},
                                                        {"rational", 8},
                                                        {"tiledesc", 9},
                                                        {"timecode", 8},
                                                        {"v2i", 8},
                                                        {"v2f", 8},
                                                        {"v2d", 16},
                                                        {"v3i", 12},
                                                        {"v3f", 12},
                                                        {"v3d", 24}};
  return sizes;
}

/// Whether it is a list of channels: names that end in 0, each with 16 bytes, then an empty name.
bool is_channel_list(std::string_view value) {
  for (size_t begin = 0;;) {
    const size_t end = value.find('\0', begin);
    if (end == std::string_view::npos) return false;
    if (end == begin) return end + 1 == value.size();
    if (value.size() - end < 1 + 16) return false;
    begin = end + 1 + 16;
  }
}

/// Whether the value is texts, each after its length.
bool is_text_list(std::string_view value) {
  for (size_t position = 0; position != value.size();) {
    const size_t rest = value.size() - position;
    if (rest < 4 || rest - 4 < little_endian(value, position)) return false;
    position += 4 + little_endian(value, position);
  }
  return true;
}

/// Whether the value is width, height, and four bytes for each pixel.
bool is_preview(std::string_view value) {
  const uint64_t width = little_endian(value, 0), height = little_endian(value, 4);
  return value.size() >= 8 && (width == 0 || height <= value.size() / width) &&
         value.size() == 8 + 4 * width * height;
}

bool is_whole(std::string_view type, std::string_view value) {
  if (const auto fixed = fixed_sizes().find(type); fixed != fixed_sizes().end())
    return value.size() == fixed->second;
  if (type == "chlist") return is_channel_list(value);
  if (type == "stringvector") return is_text_list(value);
  if (type == "floatvector") return value.size() % 4 == 0;
  if (type == "preview") return is_preview(value);
  return type != "idmanifest";  // refused: it states its own size in memory
}

}  // namespace

uint32_t little_endian(std::string_view bytes, size_t position) {
  uint32_t value = 0;
  for (size_t i = 4; i-- > 0;)
    value = value << 8 |
            (position + i < bytes.size() ? static_cast<unsigned char>(bytes[position + i]) : 0);
  return value;
}

void check_exr_attribute(std::string_view type, std::string_view value) {
  if (!is_whole(type, value))
    throw std::runtime_error("an attribute in its header is no '" + std::string(type) + "'");
}

}  // namespace mlt
