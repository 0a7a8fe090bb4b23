// erpt: energy redistribution path tracing. D. Cline, J. Talbot, P. Egbert, "Energy redistribution
// path tracing", SIGGRAPH 2005.
//
// Samples of bidirectional path tracing find paths, each with an energy e = L* mis / p. From each of
// them short chains start, in the mean e / (m e_d) of them, and each of their m mutations leaves the
// energy e_d at the path that the chain has come to. The chains start with the density of their
// target, L*, so that the expectation of what they leave is right, however short they are.
#include "base/registry.h"
#include "integrator/mixture_params.h"
#include "integrator/path_kernel.h"
#include "integrator/path_params.h"
#include "integrator/sampled_rendering.h"
#include "mutation/path_seeds.h"

#include <mutex>

namespace mlt {
namespace {

struct ErptSettings {
  PathRules rules;
  double near_specular = 0.1;
  std::vector<MixedMutation> mixture;
  double chains = 0.1;       ///< Per sample, in the mean.
  int64_t mutations = 100;   ///< Of each chain: m.
  int64_t most_chains = 64;  ///< From one path; more energy makes these deposit more.
  int64_t luminance_samples = 50000;
};

std::vector<MutationPlugin> perturbations() {
  std::vector<MutationPlugin> plugins;
  for (const MutationPlugin& plugin : mutation_plugins())
    if (plugin.has_step_size()) plugins.push_back(plugin);
  return plugins;
}

/// Leaves what chains record on the film of a sample.
class SinkRecorder : public ChainRecorder {
 public:
  SinkRecorder(SampleSink& sink, double energy) : sink_(&sink), energy_(energy) {}
  void record(const Vec2& raster, const Color& rgb_per_target, double weight, double) override {
    sink_->splat(raster, rgb_per_target * (energy_ * weight));
  }

 private:
  SampleSink* sink_;
  double energy_;
};

/// What all samples of a render need.
struct ErptChains {
  ErptChains(ScenePtr scene, const ErptSettings& s)
      : settings(s), target(std::move(scene), s.rules, s.near_specular) {
    std::vector<double> weights;
    for (const MixedMutation& mixed : settings.mixture) {
      mutations.push_back(make_mutation(mixed.name, target, mixed.values));
      weights.push_back(mixed.weight);
    }
    mixture = path_mixture(mutations, weights);
    rows = path_kernel_rows(mutations, MixtureWeights(weights));
  }

  /// m e_d: the energy of a chain.
  double chain_energy() const { return b / settings.chains; }

  ErptSettings settings;
  PathTarget target;
  Mutations mutations;
  PathMixture mixture{{}, nullptr};
  std::vector<MutationStats> rows;
  double b = 0, b_error = 0;

  std::mutex mutex;
  std::vector<ChainStats::Row> counts;  ///< As in `rows`.
  uint64_t invalid = 0;
};

class ErptTaker : public SampleTaker {
 public:
  explicit ErptTaker(ErptChains& chains)
      : chains_(&chains),
        seeds_(chains.target),
        chain_(PathKernel(chains.target, chains.mixture), {0, 0, 0, 1, chains.b}, {}) {}

  void sample(const Vec2& raster, PixelSampler& sampler, SampleSink& sink, RayCounts&) override {
    streams_ = 0;
    bool first = true;
    seeds_.draw(raster, sampler, [&](const Connection& connection, double energy) {
      if (first) key_ = static_cast<uint64_t>(sampler.next() * 0x1p53);
      first = false;
      redistribute(connection, energy, sink);
    });
  }

  void finish(SampleSink&, RayCounts& rays) override {
    rays += seeds_.rays();
    rays += chain_.stats().rays;
    const std::lock_guard lock(chains_->mutex);
    chains_->counts.resize(chains_->rows.size());
    for (size_t r = 0; r < chains_->counts.size(); ++r)
      chains_->counts[r] += exactly_summed(chain_.stats().rows[r]);
    chains_->invalid += chain_.stats().invalid;
  }

 private:
  /// Sums of such numbers are exact, in whatever order threads add them.
  static ChainStats::Row exactly_summed(ChainStats::Row row) {
    constexpr double parts = 0x1p16;
    row.acceptance = std::round(row.acceptance * parts) / parts;
    row.image_distance = std::round(row.image_distance * parts) / parts;
    return row;
  }

  /// Each sample names streams for its chains.
  Rng next_stream() { return {key_, Purpose::chain, streams_++}; }

  void redistribute(const Connection& connection, double energy, SampleSink& sink) {
    const double wanted = energy / chains_->chain_energy();
    const double most = static_cast<double>(chains_->settings.most_chains);
    const double chains = std::min(std::floor(wanted + next_stream().next()), most);
    if (chains == 0) return;
    const double per_chain = wanted > most ? energy / most : chains_->chain_energy();
    PathState start;
    seeds_.assemble(connection, start);
    if (!(start.target > 0)) return;
    const auto mutations = static_cast<uint64_t>(chains_->settings.mutations);
    SinkRecorder recorder(sink, per_chain / static_cast<double>(mutations));
    for (int i = 0; i < static_cast<int>(chains); ++i) {
      chain_.restart(start, next_stream());
      chain_.advance(mutations, recorder);
    }
  }

  ErptChains* chains_;
  PathSeeds seeds_;
  RecordedChain<PathKernel> chain_;
  uint64_t key_ = 0, streams_ = 0;
};

class ErptRendering : public SampledRendering {
 public:
  ErptRendering(ScenePtr scene, uint64_t seed, std::shared_ptr<ErptChains> chains)
      : SampledRendering(std::move(scene), seed, {true, {}, 1},
                         [chains](const Scene&) { return std::make_unique<ErptTaker>(*chains); }),
        chains_(std::move(chains)) {}

  /// Any energy of a chain is right; here it makes as many chains as are wanted.
  void prepare(int threads, const std::atomic<bool>& cancelled) override {
    const auto count = static_cast<uint64_t>(chains_->settings.luminance_samples);
    const PathStarts found =
        bootstrap(chains_->target, {seed_, Purpose::bootstrap, count}, 1, threads, cancelled);
    if (cancelled) return;
    if (!(found.b > 0)) throw no_light_found(count);
    chains_->b = found.b;
    chains_->b_error = found.b_error;
  }

  Replay replay(const Vec2i& pixel, uint64_t sample) override {
    return Rendering::replay(pixel, sample);
  }
  void add_stats(Stats& stats) const override {
    SampledRendering::add_stats(stats);
    const std::lock_guard lock(chains_->mutex);
    stats.b = chains_->b;
    stats.b_error = chains_->b_error;
    stats.invalid_samples += chains_->invalid;
    add_rows(chains_->rows, chains_->counts, stats);
  }

  std::string save(const Task& task, Content content) const override {
    ByteWriter bytes;
    bytes.write(chains_->b);
    bytes.write(chains_->b_error);
    {
      const std::lock_guard lock(chains_->mutex);
      const bool sums = content != Content::task;
      bytes.write(sums ? chains_->counts : std::vector<ChainStats::Row>());
      bytes.write(sums ? chains_->invalid : uint64_t{0});
    }
    bytes.write(SampledRendering::save(task, content));
    return bytes.take();
  }
  void load(const std::string& state) override {
    ByteReader bytes(state);
    const double b = bytes.read<double>(), b_error = bytes.read<double>();
    std::vector<ChainStats::Row> counts;
    bytes.read(counts);
    const auto invalid = bytes.read<uint64_t>();
    std::string samples;
    bytes.read(samples);
    bytes.finish();
    if (!(b > 0) || !(counts.empty() || counts.size() == chains_->rows.size()))
      throw RenderError("the saved state is damaged");
    SampledRendering::load(samples);
    const std::lock_guard lock(chains_->mutex);
    chains_->b = b;
    chains_->b_error = b_error;
    chains_->counts.resize(chains_->rows.size());
    for (size_t r = 0; r < counts.size(); ++r) chains_->counts[r] += counts[r];
    chains_->invalid += invalid;
  }

 private:
  std::shared_ptr<ErptChains> chains_;
};

class ErptIntegrator : public Integrator {
 public:
  explicit ErptIntegrator(Params& params) {
    settings_.rules = path_rules(params);
    settings_.near_specular = params.real_in("near_specular", 0, 1);
    settings_.mixture = read_mixture(params, perturbations());
    settings_.chains = params.real_in("chains", 1e-6, 1e6);
    settings_.mutations = params.integer_in("chain_length", 1, 1 << 24);
    settings_.most_chains = params.integer_in("max_chains", 1, 1 << 20);
    settings_.luminance_samples = params.integer_in("luminance_samples", 16, int64_t{1} << 40);
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    return std::make_unique<ErptRendering>(scene, seed,
                                           std::make_shared<ErptChains>(scene, settings_));
  }

 private:
  ErptSettings settings_;
};

}  // namespace

Plugin integrator_erpt() {
  return make_plugin<ErptIntegrator>(integrator_schema(
      "erpt",
      "Energy redistribution path tracing (Cline et al. 2005): short chains from the paths of "
      "bidirectional path tracing, moved by the perturbations of mlt. One spp is one sample per "
      "pixel, with its chains.",
      {path_parameters(),
       mixture_parameters(perturbations()),
       {{"near_specular", ParamType::real, 0.1,
         "Smooth vertices below this roughness count as specular in perturbations."},
        {"chains", ParamType::real, 0.1,
         "Chains per sample, in the mean. The fewer, the more samples they start from."},
        {"chain_length", ParamType::integer, int64_t{100}, "Mutations of each chain."},
        {"max_chains", ParamType::integer, int64_t{64},
         "Most chains from one path; if it is brighter than these would show, they leave more."},
        {"luminance_samples", ParamType::integer, int64_t{50000},
         "Paths drawn to know how bright the image is, and so how much a chain is to leave."}}}));
}

}  // namespace mlt
