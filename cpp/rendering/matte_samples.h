// What the camera rays of some cells see, as far as it can have a matte: surfaces, each with the
// share of its ray that ends there.
#pragma once

#include "image/splat.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace mlt {

struct SeenSurface {
  uint32_t shape;   ///< Its place in Scene::shapes().
  uint32_t object;  ///< The place of its instance, or else of its shape.
  double share;
};

inline bool operator==(const SeenSurface& a, const SeenSurface& b) {
  return a.shape == b.shape && a.object == b.object && a.share == b.share;
}

class MatteSamples {
 public:
  MatteSamples(const Scene& scene, const PixelRect& cells) : scene_(scene), cells_(cells) {}

  /// Takes samples of each cell until it has `count`. The rays are those of alpha with this seed.
  void take(uint64_t seed, uint32_t count);

  /// Whether all rays have seen the same.
  bool are_equal() const { return equal_; }
  const std::vector<SeenSurface>& first() const { return first_; }

  /// Calls add(raster, seen, end) for each sample, with the surfaces from `seen` to `end`.
  template <class Add>
  void for_each(Add&& add) const {
    const SeenSurface* seen = seen_.data();
    for (const auto& [raster, count] : samples_) {
      add(raster, seen, seen + count);
      seen += count;
    }
  }

 private:
  struct Sample {
    Vec2 raster;
    size_t count;  ///< The number of surfaces that it has seen.
  };
  void follow(Ray ray);

  const Scene& scene_;
  PixelRect cells_;
  uint32_t taken_ = 0;
  bool equal_ = true;
  std::vector<Sample> samples_;
  std::vector<SeenSurface> seen_, first_;
};

}  // namespace mlt
