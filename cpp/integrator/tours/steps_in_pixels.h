// When a tour waits. Light that stays in a pixel is a spark: a tour waits before it has left more
// energy in a pixel than samples have left there in the mean of the image, or up to three times as
// much where most light is left to tours,
//
//   steps kappa0 <= q (b + 2 e) (samples per pixel so far + 2).
//
// As that grows, the tour goes on; in the long run nothing is missing. A tour that moves about
// never waits, however long it is. The 2 keeps the first image from being dark.
#pragma once

#include "base/bytes.h"
#include "math/vec.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace mlt {

/// The bound above; `per_sample` is q (b + 2 e) / kappa0.
inline double most_steps_in_pixel(double per_sample, double samples_per_pixel) {
  return std::max(1.0, per_sample * (samples_per_pixel + 2));
}

/// The steps that a tour has made from each pixel.
class StepsInPixels {
 public:
  /// Counts a step from this raster position, unless there were `most` before.
  bool count(const Vec2& raster, double most) {
    uint32_t& steps = steps_[pixel(raster)];
    if (!(steps < most)) return false;
    ++steps;
    return true;
  }
  /// Whether count() would.
  bool has_room(const Vec2& raster, double most) const {
    const auto found = steps_.find(pixel(raster));
    return found == steps_.end() || found->second < most;
  }
  void clear() { steps_.clear(); }

  void save(ByteWriter& bytes) const {
    bytes.write(std::vector<Steps>(steps_.begin(), steps_.end()));
  }
  void load(ByteReader& bytes) {
    std::vector<Steps> steps;
    bytes.read(steps);
    steps_ = {steps.begin(), steps.end()};
  }

 private:
  using Steps = std::pair<uint64_t, uint32_t>;
  static uint64_t pixel(const Vec2& raster) {
    const auto whole = [](double x) {
      return static_cast<uint32_t>(static_cast<int32_t>(std::floor(x)));
    };
    return uint64_t{whole(raster.y)} << 32 | whole(raster.x);
  }
  std::map<uint64_t, uint32_t> steps_;
};

}  // namespace mlt
