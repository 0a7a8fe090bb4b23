#include "rendering/coarse_image.h"

#include <vector>

namespace mlt {

CoarseImage coarse_image(const MetropolisAlgorithm& algorithm, const Raster& raster, uint64_t seed,
                         uint64_t samples, int threads, const std::atomic<bool>& late) {
  std::vector<CoarseImage> images(part_count, CoarseImage(raster));
  const uint64_t stream = mix_bits(seed ^ mix_bits(uint64_t(Purpose::map)));
  in_parts(threads, samples, [&](uint64_t part, uint64_t i, uint64_t last) {
    const auto source = algorithm.source();
    for (; i < last && goes_on(images[part].drawn, late); ++i) {
      PixelSampler sampler(stream, static_cast<uint32_t>(i));
      const Vec2 position = raster.sample(sampler.next2());
      for (const FoundLight& found : source->sample(position, sampler))
        if (found.valid()) images[part].add(found);
      ++images[part].drawn;
    }
  });
  CoarseImage sum(raster);
  for (const CoarseImage& image : images) {
    sum.map.add(image.map);
    sum.b += image.b;
    sum.drawn += image.drawn;
  }
  if (sum.drawn > 0) sum.b /= static_cast<double>(sum.drawn);
  sum.map.finish();
  return sum;
}

}  // namespace mlt
