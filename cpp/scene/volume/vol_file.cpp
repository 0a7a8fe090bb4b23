#include "scene/volume/vol_file.h"

#include "base/atomic_file.h"
#include "base/error.h"

#include <fmt/format.h>

#include <half.h>

#include <cstring>

namespace mlt {
namespace {

/// How values are stored.
enum Encoding : int32_t { float32 = 1, float16 = 2, uint8 = 3 };

constexpr size_t header_size = 48;

template <class Stored, class Convert>
void read_values(const char* from, std::vector<float>& to, Convert&& convert) {
  for (size_t i = 0; i < to.size(); ++i) {
    Stored stored;
    std::memcpy(&stored, from + i * sizeof(Stored), sizeof(Stored));
    to[i] = static_cast<float>(convert(stored));
  }
}

}  // namespace

VolFile read_vol(const std::string& path) { return parse_vol(read_file(path), path); }

VolFile parse_vol(const std::string& bytes, const std::string& name) {
  const auto refuse = [&](const std::string& what) { throw FileError(name + ": " + what); };
  if (bytes.size() < header_size || bytes.compare(0, 3, "VOL") != 0)
    refuse("is no volume: it should begin with VOL and a header of 48 bytes");
  if (bytes[3] != 3) refuse(fmt::format("has version {}; only 3 is known", int{bytes[3]}));
  std::array<int32_t, 5> numbers;
  std::array<float, 6> box;
  std::memcpy(numbers.data(), &bytes[4], sizeof(numbers));
  std::memcpy(box.data(), &bytes[24], sizeof(box));
  const auto [encoding, x, y, z, channels] = numbers;
  size_t bytes_per_value = 0;
  switch (encoding) {
    case float32: bytes_per_value = 4; break;
    case float16: bytes_per_value = 2; break;
    case uint8: bytes_per_value = 1; break;
    default: refuse(fmt::format("has encoding {}; known are 1, 2 and 3", encoding));
  }
  check_grid_size({x, y, z}, channels, name);
  VolFile file{{{x, y, z}, channels, {}}, {box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
  const size_t count = size_t(x) * y * z * channels;
  if (bytes.size() != header_size + count * bytes_per_value)
    refuse(fmt::format("has {} bytes, but its header promises {}", bytes.size(),
                       header_size + count * bytes_per_value));
  file.grid.values.resize(count);
  const char* data = &bytes[0] + header_size;
  if (encoding == float32) std::memcpy(file.grid.values.data(), data, count * sizeof(float));
  if (encoding == float16) read_values<uint16_t>(data, file.grid.values, imath_half_to_float);
  if (encoding == uint8)
    read_values<uint8_t>(data, file.grid.values, [](uint8_t v) { return v / 255.0; });
  return file;
}

}  // namespace mlt
