// Alpha beside colours. Renders and EXR files have associated alpha: colours are multiplied by it.
// PNG files have straight alpha.
#pragma once

#include "image/image.h"

namespace mlt {

/// The channels of an image, and as the last one those of `alpha`, which has one.
Image with_alpha(const Image& colours, const Image& alpha);

/// Divides colours by alpha; they are black where it is 0.
Image straight(Image associated);

}  // namespace mlt
