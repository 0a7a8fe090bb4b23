// path: unidirectional path tracing with next-event estimation and multiple importance sampling.
// J. Kajiya, "The rendering equation", SIGGRAPH 1986; E. Veach and L. Guibas, "Optimally combining
// sampling techniques for Monte Carlo rendering", SIGGRAPH 1995.
#include "base/registry.h"
#include "integrator/path_params.h"
#include "integrator/sampled_rendering.h"

namespace mlt {
namespace {

class PathRendering : public SampledRendering {
 public:
  PathRendering(ScenePtr scene, uint64_t seed, const PathRules& rules)
      : SampledRendering(std::move(scene), seed, false), rules_(rules) {}

 private:
  class PathWorker : public Worker {
   public:
    PathWorker(const Scene& scene, const PathRules& rules) : scene_(&scene), rules_(rules) {}
    void sample(const Vec2& raster, PixelSampler& sampler, Sink& sink, RayCounts& rays) override {
      const auto [lens, ray] = leave_lens(scene_->camera(), raster, sampler);
      if (std::vector<FoundPath>* paths = sink.paths())
        sink.add(raster, trace_path(*scene_, rules_, ray, sampler, rays,
                                    PathRecorder(*scene_, raster, lens.at, ray.time, *paths)));
      else
        sink.add(raster, trace_path(*scene_, rules_, ray, sampler, rays));
    }

   private:
    const Scene* scene_;
    PathRules rules_;
  };

  std::unique_ptr<Worker> make_worker() override {
    return std::make_unique<PathWorker>(scene(), rules_);
  }

  PathRules rules_;
};

class PathIntegrator : public Integrator {
 public:
  explicit PathIntegrator(Params& params) : rules_(path_rules(params)) {}
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    return std::make_unique<PathRendering>(std::move(scene), seed, rules_);
  }

 private:
  PathRules rules_;
};

}  // namespace

Plugin integrator_path() {
  Schema schema;
  schema.family = "integrator";
  schema.name = "path";
  schema.doc =
      "Path tracing from the camera with next-event estimation and multiple importance sampling "
      "(Kajiya 1986; Veach & Guibas 1995). One spp is one camera path per pixel.";
  schema.parameters = path_parameters();
  schema.ignored = {"samples_per_pass", "block_size"};
  return {schema,
          [](Params& params) -> ObjectPtr { return std::make_shared<PathIntegrator>(params); }};
}

}  // namespace mlt
