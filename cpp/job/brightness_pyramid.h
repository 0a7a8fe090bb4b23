// The brightness of the pixels of an image, as far as its groups agree about it: a pixel that one
// group alone has found bright is no measure of the error there.
#pragma once

#include "job/spread.h"

namespace mlt {

/// The brightness that groups have measured in the pixels, and in blocks of 2 x 2, 4 x 4, ... of
/// them, up to the whole image.
class BrightnessPyramid {
 public:
  /// Adds the brightness of each pixel of an image of this size, as one group has measured it.
  void add(std::vector<float> brightness, const Vec2i& size, double weight);

  struct Level {
    Vec2i size;
    Spread spread;
  };
  const std::vector<Level>& levels() const { return levels_; }

 private:
  std::vector<Level> levels_;
};

/// For each pixel the brightness of the smallest block around it that is known, of an image that is
/// the sum of some parts, each with groups of its own. A value is known if it is larger than its
/// standard error, outliers apart.
std::vector<float> known_brightness(const std::vector<const BrightnessPyramid*>& parts);

}  // namespace mlt
