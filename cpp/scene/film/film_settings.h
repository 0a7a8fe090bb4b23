// The scene's settings of the image: size, filter, file format.
#pragma once

#include "base/object.h"
#include "image/filter.h"
#include "math/vec.h"
#include "math/wavelengths.h"

#include <memory>
#include <optional>
#include <string>

namespace mlt {

struct FilmSettings : Object {
  static constexpr int64_t max_side = 1 << 15, max_pixels = 1 << 28;

  Vec2i size{768, 576};
  Vec2i crop_offset{0};
  Vec2i crop_size{0};  ///< 0: the whole image.
  std::shared_ptr<const Filter> filter;
  bool half_precision = true;  ///< EXR component format.
  bool alpha = false;          ///< Whether the pixel format has alpha.
  bool spectral = false;       ///< Whether paths have wavelengths, and else R, G and B.
  std::optional<Band> band;    ///< The wavelengths of a spectral image, if not all.
};

struct SamplerSettings : Object {
  int64_t sample_count = 0;  ///< 0: not given.
};

struct FilterObject : Object {
  std::shared_ptr<const Filter> filter;
};

}  // namespace mlt
