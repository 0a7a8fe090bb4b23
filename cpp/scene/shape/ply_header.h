// The header of a PLY file (Turk 1994, "The PLY polygon file format"): the elements that follow,
// and the types of their properties.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mlt {

enum class PlyFormat { ascii, little_endian, big_endian };

enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

size_t size_of(PlyType type);
inline bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type;
  bool list = false;
  PlyType count_type = PlyType::uint8;  ///< Type of the count of a list.
};

struct PlyElement {
  std::string name;
  uint64_t count;
  std::vector<PlyProperty> properties;

  /// Index of the property with one of these names, or -1.
  int find(std::initializer_list<const char*> names) const;
  /// Bytes of one element in a binary file; lists count as empty.
  size_t least_size() const;
};

struct PlyHeader {
  PlyFormat format;
  std::vector<PlyElement> elements;
  size_t size;  ///< Bytes of the header: where the data begins.
  int lines;
};

/// Reads a header. Throws SceneError if it is malformed.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

}  // namespace mlt
