// Bytes that never change again, such as those of an array: copies share them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace mlt {

uint64_t hash_of(std::string_view bytes);

class Buffer {
 public:
  Buffer() : Buffer(std::string()) {}
  explicit Buffer(std::string bytes)
      : bytes_(std::make_shared<const std::string>(std::move(bytes))), hash_(hash_of(*bytes_)) {}

  const std::string& bytes() const { return *bytes_; }
  uint64_t hash() const { return hash_; }

  bool operator==(const Buffer& other) const {
    return bytes_ == other.bytes_ || (hash_ == other.hash_ && *bytes_ == *other.bytes_);
  }

 private:
  std::shared_ptr<const std::string> bytes_;
  uint64_t hash_;
};

}  // namespace mlt
