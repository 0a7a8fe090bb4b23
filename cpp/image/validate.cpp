#include "image/validate.h"

#include "image/exr_attributes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace mlt {
namespace {

/// The text up to the next 0, and the position after it.
std::string_view take_text(std::string_view bytes, size_t* position) {
  const size_t begin = *position, end = bytes.find('\0', begin);
  if (end == std::string_view::npos) throw std::runtime_error("the file ends early");
  *position = end + 1;
  return bytes.substr(begin, end - begin);
}

/// The fewest chunks that one header of an EXR file can mean; attributes may come twice.
class ExrChunks {
 public:
  void see(std::string_view name, std::string_view bytes, size_t value) {
    if (name == "dataWindow") {
      width_ = std::max(width_, extent(bytes, value));
      height_ = std::max(height_, extent(bytes, value + 4));
    } else if (name == "tiles") {
      tile_width_ = std::min(tile_width_, std::max<int64_t>(1, little_endian(bytes, value)));
      tile_height_ = std::min(tile_height_, std::max<int64_t>(1, little_endian(bytes, value + 4)));
    } else if (name == "chunkCount") {
      stated_ = std::max<int64_t>(stated_, little_endian(bytes, value));
    }
  }

  int64_t count() const {
    constexpr int64_t most_lines_in_a_chunk = 256;  // DWAB
    const double tiles =
        std::ceil(static_cast<double>(width_) / static_cast<double>(tile_width_)) *
        std::ceil(static_cast<double>(height_) / static_cast<double>(tile_height_));
    return std::max(
        {stated_, height_ / most_lines_in_a_chunk, static_cast<int64_t>(std::min(tiles, 1e18))});
  }

 private:
  /// max - min + 1 of a box2i whose minimum is at `position`.
  static int64_t extent(std::string_view bytes, size_t position) {
    return int64_t{static_cast<int32_t>(little_endian(bytes, position + 8))} -
           static_cast<int32_t>(little_endian(bytes, position)) + 1;
  }

  int64_t width_ = 0, height_ = 0, stated_ = 0;
  int64_t tile_width_ = int64_t{1} << 40, tile_height_ = int64_t{1} << 40;
};

}  // namespace

void check_exr_headers(std::string_view bytes) {
  const bool several_parts = (little_endian(bytes, 4) & 0x1000) != 0;
  size_t position = 8;
  do {
    if (several_parts && (position >= bytes.size() || bytes[position] == 0)) break;
    ExrChunks chunks;
    while (true) {
      const std::string_view name = take_text(bytes, &position);
      if (name.empty()) break;
      const std::string_view type = take_text(bytes, &position);
      const size_t size = little_endian(bytes, position);
      position += 4;
      if (position > bytes.size() || size > bytes.size() - position)
        throw std::runtime_error("the file ends early");
      check_exr_attribute(type, bytes.substr(position, size));
      chunks.see(name, bytes, position);
      position += size;
    }
    if (chunks.count() > static_cast<int64_t>(bytes.size() / 8))
      throw std::runtime_error("its header promises more than a file of this size can hold");
  } while (several_parts);
}

}  // namespace mlt
