// pssmlt: Metropolis light transport in primary sample space over the path tracer. C. Kelemen,
// L. Szirmay-Kalos, G. Antal, F. Csonka, "A simple and robust mutation strategy for the Metropolis
// light transport algorithm", Eurographics 2002.
#include "base/registry.h"
#include "integrator/metropolis_params.h"
#include "integrator/path_params.h"
#include "mutation/primary_sample.h"
#include "path/samplers.h"

namespace mlt {
namespace {

struct PssmltSettings {
  PathRules path;
  double large_probability = 0.3;
};

/// Walks from the camera as the numbers say, over the whole image plane.
void evaluate(const Scene& scene, const PathRules& rules, PrimaryState& state, Rng& rng,
              ChainStats& stats) {
  PrimarySampler sampler(state.numbers, rng);
  const Camera& camera = scene.camera();
  state.raster = camera.raster().sample(sampler.next2());
  const Ray ray = leave_lens(camera, state.raster, sampler).ray;
  // Importance over the density of uniform raster positions.
  const double importance = camera.raster().sampled_area() / camera.raster().pixels();
  state.rgb = trace_path(scene, rules, ray, sampler, stats.rays) * importance;
  state.target = target_luminance(state.rgb);
  state.numbers.resize(sampler.used());
  if (!(std::isfinite(state.target) && min_component(state.rgb) >= 0)) {
    ++stats.invalid;
    state.target = 0;
  }
}

class PssmltChain : public Chain {
 public:
  PssmltChain(const Scene& scene, const PssmltSettings& settings, Rng rng, PrimaryState start)
      : scene_(&scene), settings_(settings), rng_(rng), x_(std::move(start)) {
    stats_.rows.resize(2);
  }

  void advance(uint64_t steps, ChainRecorder& recorder) override {
    PrimarySampleKernel kernel(settings_.large_probability, [&](PrimaryState& state, Rng& rng) {
      evaluate(*scene_, settings_.path, state, rng, stats_);
    });
    StepRecorder<PrimaryState> record(recorder, x_);
    for (uint64_t i = 0; i < steps; ++i) {
      const Vec2 from = x_.raster;
      const uint64_t rays_before = stats_.rays.intersect + stats_.rays.occluded;
      const StepResult result = metropolis_step(x_, y_, kernel, rng_, record);
      record.settle(result, y_[0]);
      ChainStats::Row& row = stats_.rows[kernel.last()];
      stats_.count(row, result, kernel.generated(), glm::length(x_.raster - from));
      row.rays += stats_.rays.intersect + stats_.rays.occluded - rays_before;
      if (stats_.run > stats_.longest.rejections) stats_.longest = {stats_.run, x_.raster, ""};
    }
    record.finish();
  }

  const ChainStats& stats() const override { return stats_; }

  void save(ByteWriter& bytes) const override {
    bytes.write(rng_.state());
    bytes.write(x_.numbers);
    bytes.write(x_.raster);
    bytes.write(x_.rgb);
    bytes.write(x_.target);
    stats_.save(bytes);
  }
  void load(ByteReader& bytes) override {
    rng_ = Rng(bytes.read<Rng::State>());
    bytes.read(x_.numbers);
    x_.raster = bytes.read<Vec2>();
    x_.rgb = bytes.read<Color>();
    x_.target = bytes.read<double>();
    stats_.load(bytes);
  }

 private:
  const Scene* scene_;
  PssmltSettings settings_;
  Rng rng_;
  PrimaryState x_;
  std::array<PrimaryState, 1> y_;
  ChainStats stats_;
};

class Pssmlt : public MetropolisAlgorithm {
 public:
  Pssmlt(ScenePtr scene, const PssmltSettings& settings)
      : scene_(std::move(scene)), settings_(settings) {}

  double candidate(Rng& rng, RayCounts& rays) const override {
    ChainStats stats;
    const double weight = walk(rng, stats).target;
    rays.intersect += stats.rays.intersect;
    rays.occluded += stats.rays.occluded;
    return weight;
  }
  std::unique_ptr<Chain> start(const ChainId& id, Rng candidate, Rng) const override {
    ChainStats stats;
    return std::make_unique<PssmltChain>(*scene_, settings_, id.rng(), walk(candidate, stats));
  }
  std::unique_ptr<Chain> blank(const ChainId& id) const override {
    return std::make_unique<PssmltChain>(*scene_, settings_, id.rng(), PrimaryState());
  }
  std::vector<MutationStats> rows() const override {
    MutationStats large, small;
    large.name = "large_step";
    small.name = "small_step";
    return {large, small};
  }

 private:
  PrimaryState walk(Rng& rng, ChainStats& stats) const {
    PrimaryState state;
    evaluate(*scene_, settings_.path, state, rng, stats);
    return state;
  }

  ScenePtr scene_;
  PssmltSettings settings_;
};

class PssmltIntegrator : public Integrator {
 public:
  explicit PssmltIntegrator(Params& params)
      : metropolis_(metropolis_settings(params)),
        settings_{path_rules(params), params.real_in("p_large", 0, 1)} {
    if (params.boolean("bidirectional"))
      params.fail("bidirectional",
                  "is true, but pssmlt works over the path tracer only; leave it out");
    if (settings_.large_probability == 0)
      params.fail("p_large", "is 0, but without large steps a chain cannot reach the whole image");
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    auto algorithm = std::make_unique<Pssmlt>(scene, settings_);
    return std::make_unique<MetropolisRendering>(std::move(scene), seed, metropolis_,
                                                 std::move(algorithm));
  }

 private:
  MetropolisSettings metropolis_;
  PssmltSettings settings_;
};

}  // namespace

Plugin integrator_pssmlt() {
  Schema schema;
  schema.family = "integrator";
  schema.name = "pssmlt";
  schema.doc =
      "Primary-sample-space Metropolis light transport over the path tracer (Kelemen et al. 2002). "
      "One spp is one mutation per pixel.";
  schema.parameters = path_parameters();
  for (const Parameter& shared : metropolis_parameters()) schema.parameters.push_back(shared);
  schema.parameters.push_back(
      {"p_large", ParamType::real, 0.3,
       "Probability of a large step, which draws a new path independently."});
  schema.parameters.push_back(
      {"bidirectional", ParamType::boolean, false,
       "Only false: bidirectional estimators are not part of this integrator."});
  return {schema,
          [](Params& params) -> ObjectPtr { return std::make_shared<PssmltIntegrator>(params); }};
}

}  // namespace mlt
