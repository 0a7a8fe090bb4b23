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
struct PrimaryWalk {
  const Scene* scene;
  PathRules rules;
  RayCounts rays = {};

  void operator()(PrimaryState& state, Rng& rng) {
    PrimarySampler sampler(state.numbers, rng);
    walk(scene->camera().raster().sample(sampler.next2()), state, sampler);
    state.numbers.resize(sampler.used());
  }
  template <class Sampler>
  void walk(const Vec2& raster, PrimaryState& state, Sampler& sampler) {
    const Camera& camera = scene->camera();
    state.raster = raster;
    const Ray ray = leave_lens(camera, state.raster, sampler).ray;
    // Importance over the density of uniform raster positions.
    const double importance = camera.raster().sampled_area() / camera.raster().pixels();
    state.rgb = trace_path(*scene, rules, ray, sampler, rays) * importance;
    state.target = target_luminance(state.rgb);
    if (!(std::isfinite(state.target) && min_component(state.rgb) >= 0))
      state.target = std::nan("");
  }
};

/// Moves a chain that renders.
class PssmltKernel : public PrimarySampleKernel<PrimaryWalk> {
 public:
  using PrimarySampleKernel::PrimarySampleKernel;

  size_t stats_row() const { return last(); }
  size_t stats_rows() const { return 2; }
  RayCounts& rays() { return evaluate().rays; }
  std::string signature(const PrimaryState&) const { return ""; }

  void save(ByteWriter& bytes, const PrimaryState& x) const {
    bytes.write(x.numbers);
    bytes.write(x.raster);
    bytes.write(x.rgb);
    bytes.write(x.target);
  }
  void load(ByteReader& bytes, PrimaryState& x) const {
    bytes.read(x.numbers);
    for (const double u : x.numbers)
      if (!(u >= 0 && u < 1)) throw RenderError("the saved state has a number outside of [0, 1)");
    x.raster = bytes.read<Vec2>();
    x.rgb = bytes.read<Color>();
    x.target = bytes.read<double>();
  }
};

class Pssmlt : public MetropolisAlgorithm {
 public:
  Pssmlt(ScenePtr scene, const PssmltSettings& settings)
      : scene_(std::move(scene)), settings_(settings) {}

  std::unique_ptr<Source> source() const override { return std::make_unique<PssmltSource>(walk()); }
  std::unique_ptr<RenderChain> start(const ChainId& id, Rng candidate, Rng) const override {
    PrimaryState x;
    walk()(x, candidate);
    return chain(id, std::move(x));
  }
  std::unique_ptr<RenderChain> blank(const ChainId& id) const override { return chain(id, {}); }
  std::vector<MutationStats> rows() const override {
    MutationStats large, small;
    large.name = "large_step";
    small.name = "small_step";
    return {large, small};
  }

 private:
  struct PssmltSource : Source {
    explicit PssmltSource(const PrimaryWalk& w) : walk(w) {}
    const std::vector<FoundLight>& sample(const Vec2& raster, PixelSampler& sampler) override {
      return draw(raster, sampler);
    }
    const std::vector<FoundLight>& sample(const Vec2& raster, RandomSampler& sampler) override {
      return draw(raster, sampler);
    }
    template <class Sampler>
    const std::vector<FoundLight>& draw(const Vec2& raster, Sampler& sampler) {
      walk.walk(raster, state, sampler);
      found.clear();
      if (state.target != 0)
        found.push_back({state.raster, state.rgb, state.target, state.target, true});
      return found;
    }
    const RayCounts& rays() const override { return walk.rays; }

    PrimaryWalk walk;
    PrimaryState state;
    std::vector<FoundLight> found;
  };

  PrimaryWalk walk() const { return {scene_.get(), settings_.path}; }
  std::unique_ptr<RenderChain> chain(const ChainId& id, PrimaryState start) const {
    return std::make_unique<RecordedChain<PssmltKernel>>(
        PssmltKernel(settings_.large_probability, walk()), id, std::move(start));
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
    return std::make_unique<MetropolisRendering>(scene, seed, metropolis_,
                                                 std::make_unique<Pssmlt>(scene, settings_));
  }

 private:
  MetropolisSettings metropolis_;
  PssmltSettings settings_;
};

}  // namespace

Plugin integrator_pssmlt() {
  return make_plugin<PssmltIntegrator>(integrator_schema(
      "pssmlt",
      "Primary-sample-space Metropolis light transport over the path tracer (Kelemen et al. 2002). "
      "One spp is one mutation per pixel.",
      {path_parameters(),
       metropolis_parameters(),
       {{"p_large", ParamType::real, 0.3,
         "Probability of a large step, which draws a new path independently."},
        {"bidirectional", ParamType::boolean, false,
         "Only false: bidirectional estimators are not part of this integrator."}}}));
}

}  // namespace mlt
