#include "rendering/matte_samples.h"

#include "path/walk.h"
#include "rendering/sampled_rendering.h"

#include <algorithm>

namespace mlt {

void MatteSamples::take(uint64_t seed, uint32_t count) {
  for (; taken_ < count; ++taken_) {
    const CellStreams streams{mix_bits(seed), taken_};
    for (int y = cells_.y0; y < cells_.y1; ++y)
      for (int x = cells_.x0; x < cells_.x1; ++x) {
        PixelSampler sampler = streams.sampler(x, y);
        const Vec2 raster = Vec2(x, y) + sampler.next2();
        const size_t before = seen_.size();
        follow(camera_ray(scene_.camera(), raster, sampler).ray);
        samples_.push_back({raster, seen_.size() - before});
        const auto from = seen_.begin() + static_cast<std::ptrdiff_t>(before);
        if (samples_.size() == 1) first_.assign(from, seen_.end());
        equal_ = equal_ && std::equal(from, seen_.end(), first_.begin(), first_.end());
      }
  }
}

/// Adds the surfaces on a ray, as far as light comes through what is before them.
void MatteSamples::follow(Ray ray) {
  Passage through;
  SurfacePoint at;
  while (!through.is_blocked() && ray.t_max > 0 && scene_.intersect(ray, at)) {
    if (ray.medium != no_medium)
      fly(scene_.media()[ray.medium], ray, distance_to(at.p, ray), through);
    const double before = mean(through.transmittance);
    through *= scene_.passage(at, ray.d);
    const double share = before - mean(through.transmittance);
    const bool instanced = at.instance != SurfacePoint::no_shape;
    if (share > 0) seen_.push_back({at.shape, instanced ? at.instance : at.shape, share});
    ray = scene_.beyond(ray, at);
  }
}

}  // namespace mlt
