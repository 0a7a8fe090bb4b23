#include "rendering/alpha.h"

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
void divide_by_weights(const Image& sums, Image& alpha) {
  for (size_t i = 0; i < alpha.data.size(); ++i) {
    const float weight = sums.data[3 * i + 1];
    alpha.data[i] = weight > 0 ? std::clamp(sums.data[3 * i] / weight, 0.0f, 1.0f) : 0;
  }
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
  parallel_for(threads, rendering.plan().units_per_pass * alpha_samples,
               [&](uint64_t unit) { rendering.run_unit(unit); });
  divide_by_weights(rendering.film().image(), alpha);
  return alpha;
}

}  // namespace mlt
