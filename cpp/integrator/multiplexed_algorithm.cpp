#include "integrator/multiplexed_algorithm.h"

#include "integrator/path_samples.h"
#include "mutation/path_seeds.h"
#include "rendering/coarse_image.h"

namespace mlt {
namespace {

/// Moves a chain that renders.
class MultiplexedKernel : public MultiplexedStep, public KernelDefaults {
 public:
  using MultiplexedStep::MultiplexedStep;

  void record(ChainRecorder& recorder, const MultiplexedState& x, double weight) const {
    recorder.record(x.raster, x.rgb / x.target, weight, x.target_over_density, x.layers);
  }
  Vec2 raster_of(const MultiplexedState& x) const { return x.raster; }

  size_t stats_row() const { return last(); }
  size_t stats_rows() const { return 3; }
  RayCounts& rays() { return paths().rays; }
  std::string signature(const MultiplexedState& x) const {
    return "s" + std::to_string(x.technique.s) + ".t" + std::to_string(x.technique.t);
  }

  void save(ByteWriter& bytes, const MultiplexedState& x) const {
    x.numbers.save(bytes);
    bytes.write(x.technique);
    bytes.write(x.raster);
    bytes.write(x.rgb);
    bytes.write(x.target);
    bytes.write(x.target_over_density);
    bytes.write(x.layers);
  }
  void load(ByteReader& bytes, MultiplexedState& x) {
    x.numbers.load(bytes);
    x.technique = bytes.read<Technique>();
    if (x.technique.s < 0 || x.technique.t < 0 || x.technique.edges() < 1 ||
        x.technique.edges() > 1 << 16)
      throw RenderError("the saved state has a technique that does not exist");
    x.raster = bytes.read<Vec2>();
    x.rgb = bytes.read<Color>();
    x.target = bytes.read<double>();
    x.target_over_density = bytes.read<double>();
    x.layers = bytes.read<LayerMask>();
    check_layers(x.layers, paths().finder.count());
  }
};

class MultiplexedAlgorithm : public MetropolisAlgorithm {
 public:
  MultiplexedAlgorithm(ScenePtr scene, const MultiplexedSettings& settings)
      : target_(std::move(scene), settings.rules), settings_(settings), choice_(settings.rules) {}

  void keep_layers(const LightLayers* layers) override { layers_ = layers; }
  /// Estimates how much light each technique contributes.
  void prepare(const CoarseImage& coarse, uint64_t seed, int threads,
               const std::atomic<bool>& cancelled) override {
    using Light = std::vector<std::pair<Technique, double>>;
    const auto found = draw_candidates(
        Candidates{seed, Purpose::pilot, affordable(coarse.share, 8192)}, threads, cancelled,
        [&] { return std::make_unique<PathSeeds>(target_); },
        [](PathSeeds& seeds, Rng& rng) {
          Light light;
          seeds.draw(RandomSampler(rng), [&](const Connection& c, double weight) {
            light.push_back({{c.s, c.t}, weight});
          });
          return light;
        },
        [](const PathSeeds&) {});
    std::vector<std::vector<double>> sums;
    for (const Light& light : found)
      for (const auto& [technique, weight] : light) {
        const size_t k = technique.edges();
        while (sums.size() <= k) sums.emplace_back(sums.size() + 2);
        sums[k][technique.s] += weight;
      }
    choice_.learn(std::move(sums));
  }

  const Scene& scene() const override { return target_.scene(); }
  std::unique_ptr<Source> source() const override { return path_candidates(target_); }
  std::unique_ptr<Source> sample_source() const override { return path_samples(target_); }
  std::unique_ptr<SampleTaker> sample_taker(const ClampingWeights& weights) const override {
    return path_sample_taker(target_, weights);
  }
  /// Starts from one of the candidate's paths, chosen in proportion to its weight.
  std::unique_ptr<RenderChain> start(const ChainId& id, Rng candidate, Rng choice) const override {
    PrimarySamples drawn;
    PrimarySampler sampler(nullptr, drawn, {}, candidate);
    const Vec2 raster = target_.scene().camera().raster().sample(sampler.next2());
    MultiplexedState x;
    double sum = 0;
    PathSeeds(target_).draw(raster, sampler, [&](const Connection& c, double weight) {
      sum += weight;
      if (choice.next() * sum < weight) x.technique = {c.s, c.t};
    });
    paths().make_from(numbers_of(x.technique, std::move(drawn)), x, choice);
    return chain(id, std::move(x));
  }
  std::unique_ptr<RenderChain> blank(const ChainId& id, const Allocation&) const override {
    return chain(id, {});
  }

  std::vector<MutationStats> rows() const override {
    MutationStats large, small, technique;
    large.name = "large_step";
    small.name = "small_step";
    technique.name = "technique_step";
    return {large, small, technique};
  }
  std::string save() const override {
    ByteWriter bytes;
    bytes.write<uint64_t>(choice_.light().size());
    for (const auto& row : choice_.light()) bytes.write(row);
    return bytes.take();
  }
  void load(const std::string& saved) override {
    ByteReader bytes(saved);
    std::vector<std::vector<double>> light(std::min<uint64_t>(bytes.read<uint64_t>(), 1 << 17));
    for (size_t k = 0; k < light.size(); ++k) {
      bytes.read(light[k]);
      const auto right = [](double x) { return x >= 0 && std::isfinite(x); };
      if (light[k].size() != k + 2 || !std::all_of(light[k].begin(), light[k].end(), right))
        throw RenderError("the saved state has techniques that do not exist");
    }
    bytes.finish();
    choice_.learn(std::move(light));
  }

 private:
  MultiplexedPaths paths() const {
    PathRules rules = settings_.rules;
    rules.rr_depth = PathRules::no_roulette;
    return {&target_.scene(),
            {target_.scene(), {rules}},
            settings_.small_step,
            {},
            LightLayers::Finder(layers_)};
  }
  std::unique_ptr<RenderChain> chain(const ChainId& id, MultiplexedState start) const {
    return std::make_unique<RecordedChain<MultiplexedKernel>>(
        MultiplexedKernel(settings_.moves, paths(), choice_), id, std::move(start));
  }

  PathTarget target_;
  MultiplexedSettings settings_;
  TechniqueChoice choice_;
  const LightLayers* layers_ = nullptr;
};

}  // namespace

std::unique_ptr<MetropolisAlgorithm> multiplexed_algorithm(ScenePtr scene,
                                                           const MultiplexedSettings& settings) {
  return std::make_unique<MultiplexedAlgorithm>(std::move(scene), settings);
}

}  // namespace mlt
