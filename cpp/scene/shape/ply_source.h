// The values of a PLY file's body, binary or ascii.
#pragma once

#include "scene/shape/ply_header.h"
#include "scene/shape/text_scanner.h"

#include <cstring>

namespace mlt {

template <class T, bool swapped>
T load_value(const char* bytes) {
  char ordered[sizeof(T)];
  for (size_t i = 0; i < sizeof(T); ++i) ordered[i] = bytes[swapped ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return value;
}

/// Reads the values of a binary file.
template <bool swapped>
class BinarySource {
 public:
  BinarySource(std::string_view bytes, const std::string& name)
      : at_(bytes.data()), end_(bytes.data() + bytes.size()), name_(name) {}

  /// Throws if `count` elements of at least `size` bytes cannot follow.
  void expect(uint64_t count, size_t size, const std::string& what) const {
    if (size > 0 && count > remaining() / size) fail_truncated(what);
  }

  double real(PlyType type, const std::string& what) {
    switch (type) {
      case PlyType::int8: return next<int8_t>(what);
      case PlyType::uint8: return next<uint8_t>(what);
      case PlyType::int16: return next<int16_t>(what);
      case PlyType::uint16: return next<uint16_t>(what);
      case PlyType::int32: return next<int32_t>(what);
      case PlyType::uint32: return next<uint32_t>(what);
      case PlyType::float32: return next<float>(what);
      case PlyType::float64: return next<double>(what);
    }
    return 0;
  }
  int64_t integer(PlyType type, const std::string& what) {
    if (type == PlyType::int32) return next<int32_t>(what);
    return static_cast<int64_t>(real(type, what));
  }
  void skip(PlyType type, uint64_t count, const std::string& what) {
    expect(count, size_of(type), what);
    at_ += count * size_of(type);
  }
  size_t least_size(const PlyElement& element) const { return element.least_size(); }

  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError(at({name_}, message));
  }

 private:
  size_t remaining() const { return static_cast<size_t>(end_ - at_); }
  [[noreturn]] void fail_truncated(const std::string& what) const {
    fail("the file ends within its element '" + what + "'");
  }
  template <class T>
  T next(const std::string& what) {
    if (remaining() < sizeof(T)) fail_truncated(what);
    const char* from = at_;
    at_ += sizeof(T);
    return load_value<T, swapped>(from);
  }

  const char* at_;
  const char* end_;
  const std::string& name_;
};

/// Reads the values of an ascii file.
class AsciiSource {
 public:
  AsciiSource(std::string_view bytes, const std::string& name, int first_line)
      : text_(bytes, name, first_line) {}

  void expect(uint64_t count, size_t size, const std::string& what) const {
    if (size > 0 && count > (text_.remaining() + 1) / size)
      text_.fail("the file ends within its element '" + what + "'");
  }
  double real(PlyType, const std::string& what) {
    start_value(what);
    return text_.real("a number");
  }
  int64_t integer(PlyType, const std::string& what) {
    start_value(what);
    return text_.integer("an integer");
  }
  void skip(PlyType, uint64_t count, const std::string& what) {
    expect(count, 2, what);
    for (uint64_t i = 0; i < count; ++i) {
      start_value(what);
      text_.word();
    }
  }
  /// Bytes of the shortest element: a digit and a blank for each property.
  size_t least_size(const PlyElement& element) const { return 2 * element.properties.size(); }

  [[noreturn]] void fail(const std::string& message) const { text_.fail(message); }

 private:
  void start_value(const std::string& what) {
    text_.skip_space();
    if (text_.at_end()) text_.fail("the file ends within its element '" + what + "'");
  }

  TextScanner text_;
};

}  // namespace mlt
