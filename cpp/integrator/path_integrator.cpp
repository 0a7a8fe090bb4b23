// path: unidirectional path tracing with next-event estimation and multiple importance sampling.
// J. Kajiya, "The rendering equation", SIGGRAPH 1986; E. Veach and L. Guibas, "Optimally combining
// sampling techniques for Monte Carlo rendering", SIGGRAPH 1995.
#include "integrator/path_params.h"
#include "integrator/sampled_rendering.h"
#include "path/inspect.h"
#include "path/wavefront.h"

namespace mlt {
namespace {

class PathTaker : public SampleTaker {
 public:
  static PathRules settings(Params& params) { return path_rules(params); }
  PathTaker(const Scene& scene, const PathRules& rules)
      : scene_(&scene), rules_(rules), wave_(scene, rules) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    const auto [lens, ray] = leave_lens(scene_->camera(), raster, sampler);
    if (std::vector<FoundPath>* paths = sink.paths()) {
      sink.add(raster, trace_path(*scene_, rules_, ray, sampler, rays,
                                  PathRecorder(*scene_, raster, lens.at, ray.time, *paths)));
      return;
    }
    wave_.add(ray, sampler);
    rasters_.push_back(raster);
    if (wave_.full()) finish(sink, rays);
  }

  void finish(SampleSink& sink, RayCounts& rays) override {
    wave_.trace(rays);
    for (size_t i = 0; i < wave_.size(); ++i) sink.add(rasters_[i], wave_.radiance(i));
    wave_.clear();
    rasters_.clear();
  }

 private:
  const Scene* scene_;
  PathRules rules_;
  Wavefront wave_;
  std::vector<Vec2> rasters_;  ///< Of the paths in it.
};

}  // namespace

Plugin integrator_path() {
  Schema schema = integrator_schema(
      "path",
      "Path tracing from the camera with next-event estimation and multiple importance sampling "
      "(Kajiya 1986; Veach & Guibas 1995). One spp is one camera path per pixel.",
      {path_parameters()});
  schema.ignored = {"samples_per_pass", "block_size"};
  return make_plugin<SampledIntegrator<PathTaker>>(schema);
}

}  // namespace mlt
