// path: unidirectional path tracing with next-event estimation and multiple importance sampling.
// J. Kajiya, "The rendering equation", SIGGRAPH 1986; E. Veach and L. Guibas, "Optimally combining
// sampling techniques for Monte Carlo rendering", SIGGRAPH 1995.
#include "integrator/parameters.h"
#include "rendering/estimator_taker.h"
#include "wave/path_sample_wave.h"

namespace mlt {
namespace {

struct PathIntegrator : LayeredDefaults {
  static PathRules settings(Params& params) {
    PathRules rules = path_rules(params);
    rules.equiangular = params.boolean("equiangular");
    rules.through_boundaries = params.boolean("through_boundaries");
    return rules;
  }
  static SampledSettings film(const PathRules&) { return camera_walks(); }
  static std::unique_ptr<SampleTaker> taker(const Scene& scene, const PathRules& rules) {
    return take_alone(PathEstimator(scene, rules),
                      PathSampleWave::where_wanted(scene, rules, Heuristic::power));
  }
};

}  // namespace

Plugin integrator_path() {
  Schema schema = integrator_schema(
      "path",
      "Path tracing from the camera with next-event estimation and multiple importance sampling "
      "(Kajiya 1986; Veach & Guibas 1995). One spp is one camera path per pixel.",
      {path_parameters(),
       {{"equiangular", ParamType::boolean, false,
         "In media, light is also gathered where a ray passes near a lamp (Kulla & Fajardo 2012). "
         "That pays where lamps stand in thin fog. Samples are then taken one by one."}},
       {through_boundaries_parameter()},
       light_parameters()});
  schema.ignored = {"samples_per_pass", "block_size"};
  return make_plugin<SampledIntegrator<PathIntegrator>>(schema);
}

}  // namespace mlt
