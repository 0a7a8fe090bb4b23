#include "rendering/alpha.h"

#include "base/parallel.h"
#include "path/walk.h"
#include "rendering/sampled_rendering.h"

namespace mlt {
namespace {

/// Adds opacities, and the weights of the filter beside them.
class OpacityTaker : public SampleTaker {
 public:
  explicit OpacityTaker(const Scene& scene) : scene_(&scene) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    rays.count_occluded();
    const Ray ray = camera_ray(scene_->camera(), raster, sampler).ray;
    sink.add(raster, {opacity_along(*scene_, ray), 1, 0});
  }

 private:
  const Scene* scene_;
};

/// The mean that each pixel's weights give: 1 where all samples are, whatever their weights.
Image divided_by_weights(const Image& sums) {
  Image alpha(sums.width, sums.height, 1);
  for (size_t i = 0; i < alpha.data.size(); ++i) {
    const float weight = sums.data[3 * i + 1];
    alpha.data[i] = weight > 0 ? std::clamp(sums.data[3 * i] / weight, 0.0f, 1.0f) : 0;
  }
  return alpha;
}

/// Whether all pixels that samples of these cells reach have the same value.
bool is_even(const Image& alpha, const PixelRect& cells, int border) {
  const int x0 = std::max(cells.x0 - border, 0), x1 = std::min(cells.x1 + border, alpha.width);
  const int y0 = std::max(cells.y0 - border, 0), y1 = std::min(cells.y1 + border, alpha.height);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (alpha.at(x, y, 0) != alpha.at(x0, y0, 0)) return false;
  return true;
}

}  // namespace

double opacity_along(const Scene& scene, Ray ray) {
  Passage through = scene.passage(ray);
  if (!through.is_blocked() && ray.medium != no_medium && ray.t_max > 0)
    fly(scene.media()[ray.medium], ray, ray.t_max, through);
  return 1 - mean(through.transmittance);
}

Image render_alpha(const ScenePtr& scene, bool hide_emitters, uint64_t seed, int threads) {
  const Vec2i size = scene->camera().raster().size;
  const int border = filter_border(*scene->film().filter);
  Image alpha(size.x, size.y, 1);
  if (!hide_emitters && !scene->backgrounds().empty()) {
    std::fill(alpha.data.begin(), alpha.data.end(), 1.0f);
    return alpha;
  }
  SampledSettings settings;
  settings.passes_per_turn = alpha_samples;
  SampledRendering rendering(scene, seed, settings, [](const Scene& seen) {
    return std::make_unique<OpacityTaker>(seen);
  });
  const SampleFilm& film = rendering.film();
  const auto tiles = static_cast<uint64_t>(film.tile_count());
  std::vector<char> even(tiles);
  uint64_t done = 0;
  for (const uint64_t passes : {fewest_alpha_samples, alpha_samples}) {
    parallel_for(threads, (passes - done) * tiles, [&](uint64_t unit) {
      if (!even[unit % tiles]) rendering.run_unit(done * tiles + unit);
    });
    done = passes;
    alpha = divided_by_weights(film.image());
    for (uint64_t tile = 0; tile < tiles; ++tile)
      even[tile] = is_even(alpha, film.begin(static_cast<int>(tile)).cells(), border);
  }
  return alpha;
}

}  // namespace mlt
