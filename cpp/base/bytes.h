// States as bytes: plain values in sequence, checked when they are read back.
#pragma once

#include "base/error.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace mlt {

/// Clears the padding between the members of a struct, so that equal values have equal
/// bytes.
template <class T>
void clear_padding([[maybe_unused]] T& value) {
#if __has_builtin(__builtin_clear_padding)
  __builtin_clear_padding(&value);
#endif
}

class ByteWriter {
 public:
  template <class T>
  void write(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    T copy = value;
    clear_padding(copy);
    bytes_.append(reinterpret_cast<const char*>(&copy), sizeof(T));
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write<uint64_t>(values.size());
    for (const T& value : values) write(value);
  }
  template <class First, class Second>
  void write(const std::pair<First, Second>& pair) {
    write(pair.first);
    write(pair.second);
  }
  void write(const std::map<std::string, std::string>& texts) {
    write<uint64_t>(texts.size());
    for (const auto& named : texts) write(named);
  }
  template <class T>
  void write(const std::optional<T>& value) {
    write<uint64_t>(value.has_value());
    write(value.value_or(T()));
  }
  void write(const std::string& text) {
    write<uint64_t>(text.size());
    bytes_ += text;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(const std::string& bytes) : bytes_(&bytes) {}

  template <class T>
  T read() {
    static_assert(std::is_trivially_copyable_v<T>);
    if constexpr (std::is_same_v<T, bool>) return read_bool();
    T value;
    copy(&value, sizeof(T));
    check_finite(value);
    return value;
  }
  template <class T>
  void read(T& value) {
    value = read<T>();
  }
  template <class T>
  void read(std::vector<T>& values) {
    const uint64_t size = read<uint64_t>();
    if constexpr (std::is_trivially_copyable_v<T>) {
      if (size > (bytes_->size() - position_) / sizeof(T)) truncated();
      values.resize(size);
      copy(values.data(), size * sizeof(T));
      for (const T& value : values) check_finite(value);
    } else {
      for (values.clear(); values.size() < size;) read(values.emplace_back());
    }
  }
  template <class First, class Second>
  void read(std::pair<First, Second>& pair) {
    read(pair.first);
    read(pair.second);
  }
  void read(std::map<std::string, std::string>& texts) {
    for (auto left = read<uint64_t>(); left > 0; --left) {
      std::pair<std::string, std::string> named;
      read(named);
      texts.insert(std::move(named));
    }
  }
  template <class T>
  void read(std::optional<T>& value) {
    const bool given = read<uint64_t>() != 0;
    const T content = read<T>();
    value = given ? std::optional<T>(content) : std::nullopt;
  }
  void read(std::string& text) {
    const uint64_t size = read<uint64_t>();
    if (size > bytes_->size() - position_) truncated();
    text.assign(*bytes_, position_, size);
    position_ += size;
  }
  /// Throws if bytes are left.
  void finish() const {
    if (position_ != bytes_->size()) throw RenderError("the saved state is longer than expected");
  }

 private:
  bool read_bool() {
    const auto byte = read<uint8_t>();
    if (byte > 1)
      throw RenderError("the saved state has something else where it should say yes or no");
    return byte == 1;
  }
  /// Throws unless the value is finite, as sums and times are.
  template <class T>
  static void check_finite([[maybe_unused]] const T& value) {
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(value))
        throw RenderError("the saved state has a number that is not finite");
  }
  void copy(void* to, size_t size) {
    if (size > bytes_->size() - position_) truncated();
    if (size > 0) std::memcpy(to, bytes_->data() + position_, size);
    position_ += size;
  }
  [[noreturn]] static void truncated() { throw RenderError("the saved state is truncated"); }

  const std::string* bytes_;
  size_t position_ = 0;
};

}  // namespace mlt
