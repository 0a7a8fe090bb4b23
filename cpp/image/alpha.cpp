#include "image/alpha.h"

#include <algorithm>

namespace mlt {

Image with_alpha(const Image& colours, const Image& alpha) {
  Image both(colours.width, colours.height, colours.channels + 1);
  const auto channels = static_cast<size_t>(colours.channels);
  for (size_t i = 0; i < colours.pixel_count(); ++i) {
    std::copy_n(&colours.data[i * channels], channels, &both.data[i * (channels + 1)]);
    both.data[i * (channels + 1) + channels] = alpha.data[i];
  }
  return both;
}

Image straight(Image associated) {
  const auto channels = static_cast<size_t>(associated.channels);
  for (size_t i = 0; i < associated.data.size(); i += channels) {
    const float alpha = associated.data[i + channels - 1];
    for (size_t c = 0; c + 1 < channels; ++c)
      associated.data[i + c] = alpha > 0 ? associated.data[i + c] / alpha : 0;
  }
  return associated;
}

}  // namespace mlt
