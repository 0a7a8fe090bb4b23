// ptracer: light tracing (Arvo 1986; Dutre, Lafortune & Willems 1993). Walks start at the lights,
// and every vertex is connected to the lens: the technique t = 1 of bidirectional path tracing
// alone. It cannot find surfaces that the camera sees only in a mirror or through glass.
#include "integrator/parameters.h"
#include "path/bidirectional_sampler.h"
#include "rendering/sampled_rendering.h"

namespace mlt {
namespace {

class LightTaker : public SampleTaker {
 public:
  static BidirectionalSettings settings(Params& params) { return {path_rules(params)}; }
  static SampledSettings film(const BidirectionalSettings&) { return {true}; }
  LightTaker(const Scene& scene, const BidirectionalSettings& settings)
      : scene_(&scene), bidirectional_(scene, settings) {}

  void sample(const Vec2&, PixelSampler& sampler, SampleSink& sink, RayCounts& rays) override {
    bidirectional_.sample_light(sampler, rays);
    bidirectional_.connect_to_lens(rays, [&](Connection c) {
      c.weight = 1;
      sink.splat(c.raster, c.contribution);
      if (std::vector<FoundPath>* paths = sink.paths())
        paths->push_back(found_path(*scene_, bidirectional_, c));
    });
  }

 private:
  const Scene* scene_;
  BidirectionalSampler bidirectional_;
};

}  // namespace

Plugin integrator_ptracer() {
  return make_plugin<SampledIntegrator<LightTaker>>(integrator_schema(
      "ptracer",
      "Light tracing: walks from the lights, connected to the lens at each vertex (Dutre et al. "
      "1993). One spp is one light path per pixel.",
      {path_parameters()}));
}

}  // namespace mlt
