#include "integrator/path_samples.h"

#include "mutation/path_seeds.h"
#include "rendering/beside_chains.h"
#include "wave/bidirectional_wave.h"
#include "wave/path_sample_wave.h"

namespace mlt {
namespace {

using Source = MetropolisAlgorithm::Source;

// Costs of a ray over that of path_candidates(), and their range in bench_ray_cost.
constexpr double traced_cost = 0.35;        ///< .29 to .46.
constexpr double bidirectional_cost = 0.8;  ///< .75 to .93.
constexpr double wave_cost = 0.35;          ///< .3 to .4, of waves where all lights are meshes.
/// Cost of a ray of other waves, which take .83 to 1.03 of the CPU time of single samples.
constexpr double other_wave_cost = 0.7;

bool are_traced(const PathTarget& target) {
  return target.techniques() == SampleTechniques::path_tracing;
}

PathEstimator traced(const PathTarget& target) {
  return {target.scene(), target.rules(), Heuristic::balance};
}

bool in_waves(const PathTarget& target) {
  return BidirectionalWave::supports(target.scene(), PathSeeds::settings(target));
}
bool has_mesh_lights_alone(const Scene& scene) {
  for (const EmitterPtr& emitter : scene.emitters())
    if (!scene.mesh_light(emitter->index()).mesh) return false;
  return true;
}

/// Cost of a ray of bidirectional path tracing in the image, over that of a chain.
double bidirectional_sample_cost(const PathTarget& target) {
  if (!in_waves(target)) return bidirectional_cost;
  return has_mesh_lights_alone(target.scene()) ? wave_cost : other_wave_cost;
}

std::unique_ptr<Source> bidirectional(const PathTarget& target,
                                      const BidirectionalSettings& settings, double cost_of_ray) {
  const BidirectionalEstimator estimator(target.scene(), settings);
  return make_source(estimator, PathTargeting(target, estimator.own_scale()), cost_of_ray);
}

/// Samples of path tracing that count with their weights w1.
class WeightedPathEstimator : public Estimator {
 public:
  WeightedPathEstimator(const PathTarget& target, PathSampleWave::WeightsAt weights)
      : paths_(traced(target)), weights_(std::move(weights)) {}

  template <class Sampler, class Found>
  void operator()(const Vec2& raster, Sampler& sampler, RayCounts& rays, Found&& found) {
    const PathWeights weights = weights_(raster);
    paths_.paths = paths;
    paths_(raster, sampler, rays, [&](FoundLight light) {
      light.rgb *= weights.of(light.rgb, light.over_density, light.certainty);
      found(light);
    });
  }

 private:
  PathEstimator paths_;
  PathSampleWave::WeightsAt weights_;
};

std::unique_ptr<SampleTaker> traced_taker(const PathTarget& target,
                                          const ClampingWeights& weights) {
  const Scene& scene = target.scene();
  const double threshold = radiance_scale(scene) * weights.threshold();
  const auto weights_at = [&target, threshold](const Vec2& raster) {
    return PathWeights{target.factor(raster, 0) / threshold, target.factor(raster, 1) / threshold,
                       target.most_certain(raster)};
  };
  return take_alone(
      WeightedPathEstimator(target, weights_at),
      PathSampleWave::where_wanted(scene, target.rules(), Heuristic::balance, weights_at));
}

}  // namespace

std::unique_ptr<Source> path_candidates(const PathTarget& target) {
  return bidirectional(target, PathSeeds::settings(target), 1);
}

std::unique_ptr<Source> path_samples(const PathTarget& target) {
  if (!are_traced(target))
    return bidirectional(target, PathSeeds::settings(target), bidirectional_sample_cost(target));
  const PathEstimator estimator = traced(target);
  return make_source(estimator, PathTargeting(target, estimator.own_scale()), traced_cost);
}

std::unique_ptr<SampleTaker> path_sample_taker(const PathTarget& target,
                                               const ClampingWeights& weights) {
  if (are_traced(target)) return traced_taker(target, weights);
  const Scene& scene = target.scene();
  const BidirectionalSettings settings = PathSeeds::settings(target);
  const BidirectionalEstimator estimator(scene, settings);
  return take_beside_chains(scene, estimator, PathTargeting(target, estimator.own_scale()), weights,
                            BidirectionalWave::where_supported(scene, settings));
}

}  // namespace mlt
