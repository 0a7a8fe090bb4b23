#include "base/gzip.h"

#include <zlib.h>

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"

namespace mlt {
namespace {

constexpr size_t largest = size_t{1} << 28, piece = size_t{1} << 20;

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

std::string unpack_gzip(std::string_view packed, const std::string& name) {
  z_stream stream{};
  constexpr int gzip_alone = 16;
  if (inflateInit2(&stream, MAX_WBITS + gzip_alone) != Z_OK) throw FileError("zlib does not start");
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in =
      static_cast<uInt>(std::min(packed.size(), 2 * largest));  // more cannot be right
  std::string bytes;
  int result = Z_OK;
  while (result == Z_OK && bytes.size() <= largest) {
    const size_t before = bytes.size();
    bytes.resize(before + piece);
    stream.next_out = reinterpret_cast<Bytef*>(&bytes[before]);
    stream.avail_out = piece;
    result = inflate(&stream, Z_NO_FLUSH);
    bytes.resize(bytes.size() - stream.avail_out);
    // Packed files may stand behind each other.
    if (result == Z_STREAM_END && is_gzip(packed.substr(packed.size() - stream.avail_in)))
      result = inflateReset(&stream);
  }
  inflateEnd(&stream);
  if (bytes.size() > largest)
    throw FileError(
        fmt::format("{}: unpacks to more than {} bytes; unpack it yourself", name, largest));
  if (result != Z_STREAM_END) throw FileError(name + ": cannot be unpacked: it is damaged");
  return bytes;
}

}  // namespace mlt
