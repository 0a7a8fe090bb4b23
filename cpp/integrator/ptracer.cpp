// ptracer: light tracing (Arvo 1986; Dutre, Lafortune & Willems 1993). Walks start at the lights, and
// every vertex is connected to the lens: the technique t = 1 of bidirectional path tracing alone. It
// cannot see what the camera sees only by way of a mirror or through glass.
#include "base/registry.h"
#include "integrator/path_params.h"
#include "integrator/sampled_rendering.h"
#include "path/bidirectional_sampler.h"

namespace mlt {
namespace {

class PtracerRendering : public SampledRendering {
 public:
  PtracerRendering(ScenePtr scene, uint64_t seed, const BidirectionalSettings& settings)
      : SampledRendering(std::move(scene), seed, true), settings_(settings) {}

 private:
  class PtracerWorker : public Worker {
   public:
    PtracerWorker(const Scene& scene, const BidirectionalSettings& settings)
        : scene_(&scene), bidirectional_(scene, settings) {}

    void sample(const Vec2&, PixelSampler& sampler, Sink& sink, RayCounts& rays) override {
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

  std::unique_ptr<Worker> make_worker() override {
    return std::make_unique<PtracerWorker>(scene(), settings_);
  }

  BidirectionalSettings settings_;
};

class PtracerIntegrator : public Integrator {
 public:
  explicit PtracerIntegrator(Params& params) : settings_{path_rules(params)} {}
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    return std::make_unique<PtracerRendering>(std::move(scene), seed, settings_);
  }

 private:
  BidirectionalSettings settings_;
};

}  // namespace

Plugin integrator_ptracer() {
  Schema schema;
  schema.family = "integrator";
  schema.name = "ptracer";
  schema.doc =
      "Light tracing: walks from the lights, connected to the lens at each vertex (Dutre et al. "
      "1993). "
      "One spp is one light path per pixel.";
  schema.parameters = path_parameters();
  return {schema,
          [](Params& params) -> ObjectPtr { return std::make_shared<PtracerIntegrator>(params); }};
}

}  // namespace mlt
