#include "image/distrust.h"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace mlt {
namespace {

uint32_t byte_at(std::string_view bytes, size_t i) {
  return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
}

uint32_t big_endian(std::string_view bytes, size_t position, size_t count) {
  uint32_t value = 0;
  for (size_t i = 0; i < count; ++i) value = value << 8 | byte_at(bytes, position + i);
  return value;
}

enum JpegMarker : uint32_t { define_huffman = 0xc4, start_of_image = 0xd8, start_of_scan = 0xda };

/// The tables of one segment that starts at its length.
void check_huffman_segment(std::string_view bytes, size_t position) {
  const size_t end = position + big_endian(bytes, position, 2);
  for (position += 2; position < end;) {
    size_t codes = 0;
    for (size_t length = 1; length <= 16; ++length) codes += byte_at(bytes, position + length);
    if (codes > 256) throw std::runtime_error("it is corrupt: a Huffman table is too long");
    position += 17 + codes;
  }
}

}  // namespace

void check_png_chunks(std::string_view bytes) {
  size_t position = 8;
  while (position < bytes.size() && bytes.size() - position >= 12) {
    const size_t length = big_endian(bytes, position, 4);
    if (length > bytes.size() - position - 12) break;
#ifndef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
    const bool critical = (byte_at(bytes, position + 4) & 0x20) == 0;
    const auto* covered = reinterpret_cast<const Bytef*>(bytes.data() + position + 4);
    if (critical && crc32(0, covered, static_cast<uInt>(length + 4)) !=
                        big_endian(bytes, position + 8 + length, 4))
      throw std::runtime_error("it is corrupt: a checksum is wrong");
#endif
    if (bytes.substr(position + 4, 4) == "IEND") return;
    position += 12 + length;
  }
  throw std::runtime_error("the file ends early");
}

void check_jpeg_tables(std::string_view bytes) {
  // Segments follow each other up to the first scan. What stb takes for a segment after that depends
  // on the compressed data, where FF C4 cannot occur: there every FF C4 is looked at.
  size_t position = 0;
  while (position < bytes.size()) {
    if (byte_at(bytes, position) != 0xff || byte_at(bytes, position + 1) == 0xff) {
      ++position;
      continue;
    }
    const uint32_t marker = byte_at(bytes, position + 1);
    position += 2;
    if (marker == start_of_image) continue;
    if (marker == start_of_scan) break;
    if (marker == define_huffman) check_huffman_segment(bytes, position);
    position += big_endian(bytes, position, 2);
  }
  while ((position = bytes.find("\xff\xc4", position)) < bytes.size())
    check_huffman_segment(bytes, position += 2);
}

}  // namespace mlt
