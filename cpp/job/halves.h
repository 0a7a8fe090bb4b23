// Two halves of a render, which share no group: what a filter makes of one of them is compared with
// the other, which knows nothing of the filter's errors.
#pragma once

#include "rendering/integrator.h"

#include <optional>

namespace mlt {

struct Half {
  Image image;   ///< An estimate of the image, of twice its variance.
  Image robust;  ///< An estimate without fireflies (see without_fireflies).
};

struct Halves {
  Half first, second;
};

/// Halves of the image, or of one of its layers of light. Nothing while the rendering or one of its
/// parts has fewer than four groups. Needs as much memory as one image for each group of a half.
std::optional<Halves> halves(const Rendering& rendering, int layer = Rendering::all_light);

}  // namespace mlt
