// ptracer: light tracing (Arvo 1986; Dutre, Lafortune & Willems 1993). Walks start at the lights,
// and every vertex is connected to the lens: the technique t = 1 of bidirectional path tracing
// alone. It cannot find surfaces that the camera sees only in a mirror or through glass.
#include "integrator/one_ray.h"
#include "integrator/parameters.h"
#include "rendering/estimator_taker.h"
#include "wave/bidirectional_wave.h"

namespace mlt {
namespace {

struct LightIntegrator : LayeredDefaults {
  static PathRules settings(Params& params) { return path_rules(params); }
  static PathRules prepared(const PathRules& rules, const Scene& scene) {
    refuse_one_ray(scene);
    return rules;
  }
  static SampledSettings film(const PathRules&) { return {true}; }
  static std::unique_ptr<SampleTaker> taker(const Scene& scene, const PathRules& rules) {
    return take_alone(LightEstimator(scene, rules),
                      BidirectionalWave::where_supported(scene, {rules}, Techniques::to_lens));
  }
};

}  // namespace

Plugin integrator_ptracer() {
  return make_plugin<SampledIntegrator<LightIntegrator>>(integrator_schema(
      "ptracer",
      "Light tracing: walks from the lights, connected to the lens at each vertex (Dutre et al. "
      "1993). One spp is one light path per pixel.",
      {path_parameters(), light_parameters()}));
}

}  // namespace mlt
