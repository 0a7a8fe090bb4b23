// Light that comes over at most one reflection, by samples of the lights alone (Shirley, Wang &
// Zimmerman 1996, "Monte Carlo techniques for direct lighting calculations"). Mirrors stay black.
#include "path/path_tracer.h"
#include "rendering/sampled_rendering.h"

namespace mlt {
namespace {

class NextEventTaker : public SampleTaker {
 public:
  static int settings(Params& params) {
    return static_cast<int>(params.integer_in("light_samples", 1, 1000));
  }
  NextEventTaker(const Scene& scene, int light_samples) : scene_(&scene), n_(light_samples) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    CameraWalk walk(leave_lens(scene_->camera(), raster, sampler).ray);
    const Walker walker{*scene_, walk.ray.time, rays};
    SurfacePoint at;
    const bool hit = arrive(walker, sampler, walk, at);
    const Vec3 w = walk.ray.d;
    const auto alone = [](auto&&...) { return 1.0; };  // its weight: no other technique takes part
    Color radiance =
        walk.seen(walk.throughput * emission(*scene_, hit ? &at : nullptr, walk.ray, alone));
    for (int i = 0; hit && i < n_; ++i) {
      const Vec2 u = sampler.next2();
      const auto light = direct_light(walker, at, -w, {sampler.next(), u}, false, alone);
      radiance += walk.seen(walk.throughput * light.radiance, light.disperses) / double(n_);
    }
    sink.add(raster, radiance);
  }

 private:
  const Scene* scene_;
  int n_;
};

}  // namespace

Plugin integrator_next_event() {
  return make_plugin<SampledIntegrator<NextEventTaker>>(integrator_schema(
      "next_event", "Direct light by samples of the lights alone.",
      {{{"light_samples", ParamType::integer, int64_t{1}, "Samples of lights per camera ray."}}}));
}

}  // namespace mlt
