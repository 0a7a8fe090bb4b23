// path: unidirectional path tracing with next-event estimation and multiple importance sampling.
// J. Kajiya, "The rendering equation", SIGGRAPH 1986; E. Veach and L. Guibas, "Optimally combining
// sampling techniques for Monte Carlo rendering", SIGGRAPH 1995.
#include "integrator/parameters.h"
#include "rendering/wave_taker.h"

namespace mlt {
namespace {

class PathTaker : public WaveTaker {
 public:
  static PathRules settings(Params& params) { return path_rules(params); }
  static SampledSettings film(const PathRules&) { return camera_walks(); }
  PathTaker(const Scene& scene, const PathRules& rules)
      : WaveTaker(scene, rules, Heuristic::power) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink,
              RayCounts& rays) override {
    const LensDeparture start = leave_lens(scene().camera(), raster, sampler);
    const auto trace = [&](auto&& watcher) {
      sink.add(raster, trace_path(scene(), rules(), start.ray, sampler, rays, watcher));
    };
    if (sink.paths())
      trace(PathRecorder(scene(), raster, start.lens.at, start.ray.time, *sink.paths()));
    else
      trace(IgnorePaths());
  }
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
