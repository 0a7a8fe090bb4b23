// Light that comes over at most one reflection, by samples of the lights alone (Shirley, Wang &
// Zimmerman 1996, "Monte Carlo techniques for direct lighting calculations"). Mirrors stay black.
#include "rendering/estimator_taker.h"

namespace mlt {
namespace {

class NextEventEstimator : public Estimator, public SampledDefaults {
 public:
  static int settings(Params& params) {
    return static_cast<int>(params.integer_in("light_samples", 1, 1000));
  }
  static std::unique_ptr<SampleTaker> taker(const Scene& scene, int light_samples) {
    return take_alone(NextEventEstimator(scene, light_samples));
  }
  NextEventEstimator(const Scene& scene, int light_samples) : scene_(&scene), n_(light_samples) {}

  template <class Sampler, class Found>
  void operator()(const Vec2& raster, Sampler& sampler, RayCounts& rays, Found&& found) const {
    CameraWalk walk(camera_ray(scene_->camera(), raster, sampler).ray);
    const Walker walker{*scene_, walk.ray.time, rays};
    SurfacePoint at;
    const bool hit = arrive(walker, sampler, walk, at);
    const Vec3 w = walk.ray.d;
    const auto alone = [](auto&&...) { return 1.0; };  // its weight: no other technique takes part
    Color radiance =
        walk.seen(walk.throughput * emission(*scene_, hit ? &at : nullptr, walk.ray, alone));
    for (int i = 0; hit && i < n_; ++i) {
      const auto chosen = sample_direct_position(*scene_, at, {sampler.next(), sampler.next2()});
      const DirectLight light = direct_light(walker, at, -w, chosen, false, alone);
      radiance += walk.seen(walk.throughput * light.radiance, light.disperses) / double(n_);
    }
    found(FoundLight{{raster, radiance}});
  }

 private:
  const Scene* scene_;
  int n_;
};

}  // namespace

Plugin integrator_next_event() {
  return make_plugin<SampledIntegrator<NextEventEstimator>>(integrator_schema(
      "next_event", "Direct light by samples of the lights alone.",
      {{{"light_samples", ParamType::integer, int64_t{1}, "Samples of lights per camera ray."}}}));
}

}  // namespace mlt
