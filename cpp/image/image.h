// An image in memory: interleaved floats, row 0 on top. The meaning of its numbers is defined by
// files and films.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"

namespace mlt {

/// The most pixels of an image: a file with more is damaged or hostile.
constexpr int64_t max_image_pixels = int64_t{1} << 31;

struct Image {
  Image() = default;
  /// A black image; a UsageError if a size is not positive or the image would be too large.
  Image(int w, int h, int c) : width(w), height(h), channels(c), data(sample_count(w, h, c)) {}

  bool empty() const { return data.empty(); }
  size_t pixel_count() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  size_t index(int x, int y, int c) const {
    return (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) *
               static_cast<size_t>(channels) +
           static_cast<size_t>(c);
  }
  float& at(int x, int y, int c) { return data[index(x, y, c)]; }
  float at(int x, int y, int c) const { return data[index(x, y, c)]; }

  static size_t sample_count(int w, int h, int c) {
    if (w <= 0 || h <= 0 || c <= 0 || c > 1024 || int64_t{w} * h > max_image_pixels)
      throw UsageError("an image cannot have " + std::to_string(w) + " x " + std::to_string(h) +
                       " pixels with " + std::to_string(c) +
                       " channels; sizes must be positive, with at most 2^31 pixels");
    return static_cast<size_t>(w) * static_cast<size_t>(h) * static_cast<size_t>(c);
  }

  int width = 0, height = 0, channels = 0;
  std::vector<float> data;
};

/// Adds an image of the same size.
inline Image& operator+=(Image& a, const Image& b) {
  for (size_t i = 0; i < a.data.size(); ++i) a.data[i] += b.data[i];
  return a;
}

inline bool operator==(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height && a.channels == b.channels && a.data == b.data;
}

}  // namespace mlt
