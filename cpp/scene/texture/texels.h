// The colours of an image texture. Images of 8 bits a channel stay bytes, with a table of what the
// bytes mean: a quarter of the memory, and so fewer cache misses, for the same numbers.
#pragma once

#include "image/image.h"
#include "math/color.h"

#include <array>

namespace mlt {

class Texels {
 public:
  using Meaning = std::array<float, 256>;

  /// 1 (grey) or 3 (RGB) channels.
  explicit Texels(Image image) : size_(image), floats_(std::move(image.data)) {}
  /// Each channel of a texel is meaning[b], where b / 255 is what the image holds there.
  Texels(const Image& image, const Meaning& meaning)
      : size_(image), meaning_(meaning), bytes_(image.data.size()) {
    for (size_t i = 0; i < bytes_.size(); ++i)
      bytes_[i] = static_cast<uint8_t>(image.data[i] * 255 + 0.5f);
  }

  int width() const { return size_.width; }
  int height() const { return size_.height; }

  void prefetch(int x, int y) const {
    const size_t i = place(x, y);
    __builtin_prefetch(bytes_.empty() ? static_cast<const void*>(&floats_[i]) : &bytes_[i]);
  }

  Color operator()(int x, int y) const {
    const size_t i = place(x, y);
    if (bytes_.empty()) return color([&](int c) { return floats_[i + c]; });
    return color([&](int c) { return meaning_[bytes_[i + c]]; });
  }

 private:
  size_t place(int x, int y) const {
    return size_.channels * (static_cast<size_t>(y) * size_.width + x);
  }
  struct Size {
    explicit Size(const Image& image)
        : width(image.width), height(image.height), channels(image.channels) {}
    int width, height, channels;
  };

  template <class Channel>
  Color color(Channel&& channel) const {
    return size_.channels == 1 ? Color(channel(0)) : Color(channel(0), channel(1), channel(2));
  }

  Size size_;
  Meaning meaning_{};
  std::vector<uint8_t> bytes_;  ///< Or, if it is empty:
  std::vector<float> floats_;
};

}  // namespace mlt
