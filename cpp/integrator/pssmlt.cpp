// pssmlt: Metropolis light transport in primary sample space. C. Kelemen, L. Szirmay-Kalos,
// G. Antal, F. Csonka, "A simple and robust mutation strategy for the Metropolis light transport
// algorithm", Eurographics 2002.
#include "base/registry.h"
#include "integrator/one_ray.h"
#include "integrator/parameters.h"
#include "path/layered_sample.h"
#include "rendering/beside_chains.h"
#include "rendering/coarse_image.h"
#include "wave/path_sample_wave.h"
#include "wave/walk_step.h"

namespace mlt {
namespace {

struct PssmltSettings {
  PathRules path;
  SmallStep small_step;
  double large_probability = 0.3;
  bool delayed_rejection = false;
};

/// Evaluates states: makes paths from their numbers.
template <class Estimator>
struct PrimaryPaths {
  const Scene* scene;
  SmallStep small_step;
  Estimator estimator;
  RayCounts rays = {};
  LightLayers::Finder finder{nullptr};
  LayeredSample layered = {};

  void operator()(const PrimarySamples* x, PrimaryState& y, Rng& rng) {
    PrimarySampler sampler(x, y.numbers, small_step, rng);
    const Vec2 raster = scene->camera().raster().sample(sampler.next2());
    const double unit = radiance_scale(*scene) / estimator.own_scale();
    y.light.clear();
    const auto take = [&](const FoundLight& light) { y.add(light, unit); };
    if (finder.count() > 0)
      layered(estimator, raster, sampler, rays, finder, take);
    else
      estimator(raster, sampler, rays, take);
    y.find_target();
  }
};

/// Moves a chain that renders.
template <class Step>
class PssmltKernel : public Step, public KernelDefaults {
 public:
  /// `b` is that of the group of chains, `layers` the number of layers of light.
  PssmltKernel(const Step& step, const LargeStepWeights& weights, double b, int layers)
      : Step(step),
        weights_(weights),
        layers_(layers),
        large_step_weight_(weights.share / (step.large_probability() * b)) {}

  void record(ChainRecorder& recorder, const PrimaryState& x, double weight) const {
    const double denominator = weights_.denominator(x.target);
    for (const ImageLight& light : x.light)
      recorder.record(light.raster, light.rgb / denominator, weight, denominator, light.layers);
  }
  double proposal_weight() const { return this->last() == Step::large ? large_step_weight_ : 0; }

  size_t stats_row() const { return this->last(); }
  size_t stats_rows() const { return 2; }
  std::string signature(const PrimaryState&) const { return ""; }
  Vec2 raster_of(const PrimaryState& x) const {
    return x.light.empty() ? Vec2(0) : x.light[0].raster;
  }

  void save(ByteWriter& bytes, const PrimaryState& x) const {
    x.numbers.save(bytes);
    bytes.write(x.light);
    bytes.write(x.target);
  }
  void load(ByteReader& bytes, PrimaryState& x) const {
    x.numbers.load(bytes);
    bytes.read(x.light);
    for (const ImageLight& one : x.light) check_layers(one.layers, layers_);
    x.target = bytes.read<double>();
  }

 private:
  LargeStepWeights weights_;
  int layers_;
  double large_step_weight_;
};

/// Pssmlt over any estimator. With PrimaryStep chains advance one after the other.
template <class Estimator, class Step = PrimaryStep<PrimaryPaths<Estimator>>>
class Pssmlt : public MetropolisAlgorithm {
 public:
  Pssmlt(ScenePtr scene, const PssmltSettings& settings)
      : scene_(std::move(scene)), settings_(settings) {}

  void keep_layers(const LightLayers* layers) override { layers_ = layers; }
  void prepare(const CoarseImage& coarse, uint64_t, int, const std::atomic<bool>&) override {
    weights_.share = settings_.large_probability * coarse.b;
  }
  const Scene& scene() const override { return *scene_; }
  std::unique_ptr<Source> source() const override {
    return make_source(estimator(), targeting(), is_path ? path_cost : 1);
  }
  std::unique_ptr<SampleTaker> sample_taker(const ClampingWeights& weights) const override {
    std::unique_ptr<PathSampleWave> wave;
    if (is_path) wave = PathSampleWave::where_wanted(*scene_, settings_.path, Heuristic::power);
    return take_beside_chains(*scene_, estimator(), targeting(), weights, std::move(wave));
  }
  std::unique_ptr<RenderChain> start(const ChainId& id, Rng candidate, Rng) const override {
    PrimaryState x;
    paths()(nullptr, x, candidate);
    return chain(id, std::move(x));
  }
  /// A mutation makes a whole sample.
  double cost_of_mutation(double rays_of_sample) const override { return 1 + rays_of_sample; }
  std::unique_ptr<RenderChain> blank(const ChainId& id, const Allocation&) const override {
    return chain(id, {});
  }
  std::vector<MutationStats> rows() const override {
    MutationStats large, small;
    large.name = "large_step";
    small.name = "small_step";
    return {large, small};
  }
  std::string save() const override {
    ByteWriter bytes;
    bytes.write(weights_);
    return bytes.take();
  }
  void load(const std::string& saved) override {
    ByteReader bytes(saved);
    weights_ = bytes.read<LargeStepWeights>();
    bytes.finish();
  }

 protected:
  PrimaryPaths<Estimator> paths() const {
    return {scene_.get(), settings_.small_step, estimator(), {}, LightLayers::Finder(layers_)};
  }
  const PssmltSettings& settings() const { return settings_; }

 private:
  static constexpr bool is_path = std::is_same_v<Estimator, PathEstimator>;
  /// Cost of a ray of path tracing in waves: .56 to .8 in bench_ray_cost.
  static constexpr double path_cost = 0.65;

  Estimator estimator() const { return {*scene_, settings_.path}; }
  SampleTargeting targeting() const { return {*scene_, estimator().own_scale(), weights_}; }
  Step step() const {
    if constexpr (std::is_same_v<Step, WalkStep>)
      return {settings_.large_probability, settings_.delayed_rejection};
    else
      return {settings_.large_probability, settings_.delayed_rejection, paths()};
  }
  std::unique_ptr<RenderChain> chain(const ChainId& id, PrimaryState start) const {
    return std::make_unique<RecordedChain<PssmltKernel<Step>>>(
        PssmltKernel<Step>(step(), weights_, id.b, layers_ ? layers_->count() : 0), id,
        std::move(start));
  }

  ScenePtr scene_;
  PssmltSettings settings_;
  LargeStepWeights weights_;
  const LightLayers* layers_ = nullptr;
};

/// Pssmlt over path tracing: the proposals of many chains are traced side by side.
class WalkPssmlt : public Pssmlt<PathEstimator, WalkStep> {
 public:
  using Pssmlt::Pssmlt;

  int chains_together() const override { return 8; }
  void advance(const std::vector<ChainVisit>& visits, uint64_t steps) const override {
    using Kernel = PssmltKernel<WalkStep>;
    WalkWave wave(scene(), settings().path, settings().small_step);
    std::vector<RecordedChain<Kernel>*> chains;
    std::vector<StepRecorder<Kernel>> recorders;
    for (const ChainVisit& visit : visits) {
      chains.push_back(static_cast<RecordedChain<Kernel>*>(visit.chain));
      recorders.push_back(chains.back()->begin(*visit.recorder));
    }
    for (; steps > 0; --steps) {
      for (size_t stage = 0; stage < Kernel::stages; ++stage) {
        for (RecordedChain<Kernel>* chain : chains) chain->prepare(stage, wave);
        wave.trace();
      }
      for (size_t i = 0; i < chains.size(); ++i) chains[i]->step(recorders[i]);
    }
    for (StepRecorder<Kernel>& recorder : recorders) recorder.finish();
  }
};

class PssmltIntegrator : public Integrator {
 public:
  explicit PssmltIntegrator(Params& params)
      : metropolis_(metropolis_settings(params)),
        estimator_(params.text("estimator")),
        settings_{path_rules(params), small_step(params), large_probability(params),
                  params.boolean("delayed_rejection")} {
    if (params.has("bidirectional")) {
      const bool bidirectional = params.boolean("bidirectional");
      if (params.has("estimator") && bidirectional != (estimator_ == "bdpt"))
        params.fail("bidirectional", "contradicts 'estimator'; leave it out");
      if (bidirectional) estimator_ = "bdpt";
    }
    metropolis_.only_camera_walks = estimator_ == "path";
    metropolis_.light = light_layers(params);
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    return std::make_unique<MetropolisRendering>(scene, seed, metropolis_, algorithm(scene));
  }

 private:
  std::unique_ptr<MetropolisAlgorithm> algorithm(const ScenePtr& scene) const {
    if (estimator_ == "bdpt")
      return std::make_unique<Pssmlt<BidirectionalEstimator>>(scene, settings_);
    if (estimator_ == "ptracer") {
      refuse_one_ray(*scene);
      return std::make_unique<Pssmlt<LightEstimator>>(scene, settings_);
    }
    if (!settings_.path.waves || scene->camera().clips_far() || metropolis_.light.any())
      return std::make_unique<Pssmlt<PathEstimator>>(scene, settings_);
    return std::make_unique<WalkPssmlt>(scene, settings_);
  }

  MetropolisSettings metropolis_;
  std::string estimator_;
  PssmltSettings settings_;
};

}  // namespace

Plugin integrator_pssmlt() {
  return make_plugin<PssmltIntegrator>(integrator_schema(
      "pssmlt",
      "Primary-sample-space Metropolis light transport (Kelemen et al. 2002): mutates the random "
      "numbers of another integrator. One spp is one mutation per pixel.",
      {path_parameters(),
       light_parameters(),
       chain_parameters(256),
       family_parameters(),
       primary_step_parameters(),
       {{"estimator",
         ParamType::text,
         std::string("path"),
         "The integrator whose numbers are mutated: `path`, `bdpt`, or `ptracer`, which does not "
         "see lights directly or in mirrors.",
         {"path", "bdpt", "ptracer"}},
        {"bidirectional", ParamType::boolean, no_default,
         "True stands for the estimator `bdpt`, as in Mitsuba 0.6."}}}));
}

}  // namespace mlt
