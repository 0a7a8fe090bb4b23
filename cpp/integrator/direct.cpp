// direct: light that reaches the camera over at most one reflection, by any number of samples of
// lights and of the BSDF, combined by the multi-sample power heuristic (Veach 1997, sec. 9.2).
#include "integrator/parameters.h"
#include "rendering/estimator_taker.h"
#include "wave/path_sample_wave.h"

namespace mlt {
namespace {

struct DirectSettings {
  int emitter_samples = 1, bsdf_samples = 1;
  PathRules rules;
};

class DirectEstimator : public Estimator, public LayeredDefaults {
 public:
  static DirectSettings settings(Params& params) {
    const int64_t both = params.integer_in("shading_samples", 1, 1 << 20);
    const auto count = [&](const char* name) {
      return static_cast<int>(params.has(name) ? params.integer_in(name, 0, 1 << 20) : both);
    };
    DirectSettings settings;
    settings.emitter_samples = count("emitter_samples");
    settings.bsdf_samples = count("bsdf_samples");
    if (settings.emitter_samples + settings.bsdf_samples == 0)
      params.fail("needs at least one of emitter_samples and bsdf_samples to be positive");
    settings.rules.max_depth = 2;
    settings.rules.rr_depth = PathRules::no_roulette;
    settings.rules.hide_emitters = params.boolean("hide_emitters");
    settings.rules.strict_normals = params.boolean("strict_normals");
    settings.rules.waves = params.boolean("waves");
    return settings;
  }
  static SampledSettings film(const DirectSettings&) { return camera_walks(); }
  /// One sample of each kind is path tracing that ends after one reflection.
  static std::unique_ptr<SampleTaker> taker(const Scene& scene, const DirectSettings& settings) {
    const auto& [emitter_samples, bsdf_samples, rules] = settings;
    if (emitter_samples == 1 && bsdf_samples == 1)
      return take_alone(PathEstimator(scene, rules),
                        PathSampleWave::where_wanted(scene, rules, Heuristic::power));
    return take_alone(DirectEstimator(scene, settings));
  }
  DirectEstimator(const Scene& scene, const DirectSettings& settings)
      : scene_(&scene), settings_(settings) {}

  template <class Sampler, class Found>
  void operator()(const Vec2& raster, Sampler& sampler, RayCounts& rays, Found&& found) const {
    const CameraRay start = camera_ray(scene_->camera(), raster, sampler);
    watch(raster, start, found, [&](auto&& watcher) { trace(start.ray, sampler, rays, watcher); });
  }

 private:
  template <class Sampler, class Watcher>
  void trace(const Ray& ray, Sampler& sampler, RayCounts& rays, Watcher& watcher) const {
    const Walker walker{*scene_, ray.time, rays};
    CameraWalk walk(ray);
    SurfacePoint at;
    const bool hit = arrive(walker, sampler, walk, at);
    const auto always = [](const Emitter&, const SurfacePoint&) { return 1.0; };
    if (!settings_.rules.hide_emitters)
      find_emission(walk, hit ? &at : nullptr, 1, always, watcher);
    if (!hit || !consistent_sides(at, -ray.d, settings_.rules.strict_normals)) return;
    watcher.arrive(at);
    if (BsdfAt(*scene_, at).has_smooth())
      for (int i = 0; i < settings_.emitter_samples; ++i)
        by_light(walker, at, walk, sampler, watcher);
    for (int i = 0; i < settings_.bsdf_samples; ++i) by_bsdf(walker, at, walk, sampler, watcher);
  }

  /// Tells the emission where the ray of a walk ends, one of `count` samples.
  template <class Weight, class Watcher>
  void find_emission(const CameraWalk& walk, const SurfacePoint* at, double count, Weight&& weight,
                     Watcher& watcher) const {
    const auto take = [&](const Emitter& emitter, const SurfacePoint& x0, const Spectrum& emitted) {
      const Color light = walk.seen(walk.throughput * (emitted * weight(emitter, x0))) / count;
      watcher.find(walk, light, 0);
      watcher.hit(emitter, x0, light);
    };
    visit_emission(*scene_, at, walk.ray, take);
  }

  template <class Sampler, class Watcher>
  void by_light(const Walker& walker, const SurfacePoint& at, const CameraWalk& seen,
                Sampler& sampler, Watcher& watcher) const {
    const Vec3 u = DirectNumbers::draw(sampler).for_light();
    const double n = settings_.emitter_samples, m = settings_.bsdf_samples;
    const auto weight = [&](double light, double bsdf) {
      return MisExponent(Heuristic::power).weight(n * light, m * bsdf);
    };
    const LightSample chosen = sample_direct_position(*scene_, at, u);
    const DirectLight light = direct_light(walker, at, -seen.ray.d, chosen,
                                           settings_.rules.strict_normals, weight, seen.likelihood);
    const Color found = seen.seen(seen.throughput * light.radiance, light.disperses) / n;
    watcher.find(seen, found, 0);
    watcher.connect(chosen, found);
  }

  template <class Sampler, class Watcher>
  void by_bsdf(const Walker& walker, const SurfacePoint& at, const CameraWalk& seen,
               Sampler& sampler, Watcher& watcher) const {
    const Vec2 u = sampler.next2();
    const auto sample = scatter_to_light(walker, at, -seen.ray.d, {sampler.next(), u},
                                         settings_.rules.strict_normals);
    if (!sample) return;
    watcher.scatter(sample->lobe);
    const double n = settings_.emitter_samples, m = settings_.bsdf_samples;
    CameraWalk walk(walker.leave(at, sample->w));
    walk.throughput = seen.throughput * sample->weight;
    walk.dispersed = sample->disperses;
    walk.scatter_pdf = sample->pdf;
    walk.likelihood = seen.likelihood;
    SurfacePoint next;
    const bool hit = arrive(walker, sampler, walk, next);
    const auto weight = [&](const Emitter& emitter, const SurfacePoint& x0) {
      if (sample->lobe != Lobe::smooth) return 1.0;
      const double light = direct_pdf(*scene_, emitter, at.p, x0, sample->w);
      return MisExponent(Heuristic::power).weight(m * walk.scatter_pdf, n * light);
    };
    find_emission(walk, hit ? &next : nullptr, m, weight, watcher);
  }

  const Scene* scene_;
  DirectSettings settings_;
};

}  // namespace

Plugin integrator_direct() {
  Schema schema = integrator_schema(
      "direct",
      "Direct light: one reflection at the most, sampled from lights and BSDFs (Veach 1997, sec. "
      "9.2). One spp is one camera ray per pixel.",
      {{{"shading_samples", ParamType::integer, int64_t{1}, "Sets both of the numbers below."},
        {"emitter_samples",
         ParamType::integer,
         {},
         "Samples of lights per camera ray (default: shading_samples)."},
        {"bsdf_samples",
         ParamType::integer,
         {},
         "Samples of the BSDF per camera ray (default: shading_samples)."}}});
  for (const Parameter& shared : path_parameters())
    if (shared.name != "max_depth" && shared.name != "rr_depth")
      schema.parameters.push_back(shared);
  for (const Parameter& layers : light_parameters()) schema.parameters.push_back(layers);
  return make_plugin<SampledIntegrator<DirectEstimator>>(schema);
}

}  // namespace mlt
