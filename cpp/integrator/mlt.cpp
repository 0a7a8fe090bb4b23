// mlt: Metropolis light transport in path space. E. Veach and L. Guibas, "Metropolis light transport",
// SIGGRAPH 1997; Veach 1997, ch. 11.
#include "integrator/mlt.h"

#include "base/parallel.h"
#include "base/registry.h"
#include "integrator/metropolis_params.h"
#include "integrator/metropolis_rendering.h"
#include "integrator/path_params.h"
#include "integrator/separate_direct.h"
#include "mutation/adaptation.h"
#include "mutation/mixture.h"
#include "mutation/mutation_registry.h"
#include "mutation/path_seeds.h"

namespace mlt {
namespace {

struct MltSettings {
  BidirectionalSettings paths;
  MutationSettings mutation;
  std::vector<std::pair<std::string, double>> weights;  ///< Of each mutation, by name.
  std::vector<ExtraMutation> extra;
  bool adaptive = true;
  bool two_stage = false;
  int64_t luminance_samples = 100000;
};

/// Step sizes among which adaptation chooses: largest radii, as shares of the image's diagonal.
constexpr double adaptive_shares[] = {0.02, 0.1};

class MltChain : public Chain {
 public:
  MltChain(const Scene& scene, const MutationSettings& settings, const Mutations& mutations,
           const MutationChoice& choice, const ChainId& id, PathState start)
      : scene_(&scene),
        settings_(&settings),
        mutations_(&mutations),
        choice_(&choice),
        id_(id),
        round_key_(mix_bits(id.seed ^ mix_bits(static_cast<uint64_t>(id.group)))),
        rng_(id.rng()),
        x_(std::move(start)) {
    stats_.rows.resize(mutations.size() * (longest_row + 1));
  }

  void advance(uint64_t steps, ChainRecorder& recorder) override {
    MutationMixture kernel(*mutations_, *choice_, stats_.rays);
    StepRecorder<PathState> record(recorder, x_);
    for (uint64_t i = 0; i < steps; ++i, ++step_) {
      kernel.set_stratified_raster(round_raster());
      const Vec2 from = x_.raster;
      const int edges = x_.edges();
      const uint64_t rays_before = stats_.rays.intersect + stats_.rays.occluded;
      const StepResult result = metropolis_step(x_, y_, kernel, rng_, record);
      record.settle(result, y_[0]);
      ChainStats::Row& row =
          stats_.rows[kernel.chosen() * (longest_row + 1) + std::min(edges, longest_row)];
      stats_.count(row, result, kernel.generated(), glm::length(x_.raster - from));
      row.rays += stats_.rays.intersect + stats_.rays.occluded - rays_before;
      if (stats_.run > stats_.longest.rejections && stats_.run % 64 == 0)
        stats_.longest = {stats_.run, x_.raster,
                          signature(*scene_, x_.path, settings_->near_specular)};
    }
    record.finish();
  }

  const ChainStats& stats() const override { return stats_; }

  void save(ByteWriter& bytes) const override {
    bytes.write(rng_.state());
    bytes.write(step_);
    mlt::save(bytes, x_.path);
    stats_.save(bytes);
  }
  void load(ByteReader& bytes) override;

 private:
  /// The image position of this chain among those of all chains of the group in this step.
  StratifiedRaster round_raster() const {
    return {&scene_->camera().raster(), static_cast<uint32_t>(id_.number),
            static_cast<uint32_t>(id_.count), mix_bits(round_key_ + step_)};
  }

  const Scene* scene_;
  const MutationSettings* settings_;
  const Mutations* mutations_;
  const MutationChoice* choice_;
  ChainId id_;
  uint64_t round_key_;  ///< Names the rounds of the chain's group.
  Rng rng_;
  uint64_t step_ = 0;
  PathState x_;
  std::array<PathState, 1> y_;
  ChainStats stats_;
};

class Mlt : public MetropolisAlgorithm {
 public:
  Mlt(ScenePtr scene, const MltSettings& settings)
      : scene_(std::move(scene)), settings_(settings), choice_(std::vector<double>()) {
    if (settings_.two_stage) {
      map_ = std::make_unique<TargetMap>(scene_->camera().raster(), 16);
      settings_.mutation.map = map_.get();
    }
    std::vector<double> weights;
    for (const auto& [name, weight] : settings_.weights) {
      if (!settings_.adaptive || !mutation_kind(name).perturbation) {
        add(name, settings_.mutation.largest_share);
        weights.push_back(weight);
        continue;
      }
      for (const double share : adaptive_shares) {
        add(name, share);
        weights.push_back(weight / std::size(adaptive_shares));
      }
    }
    for (const ExtraMutation& extra : settings_.extra) {
      mutations_.push_back(extra.make(*scene_, settings_.mutation));
      steps_.push_back(0);
      weights.push_back(extra.weight);
    }
    choice_ = MutationChoice(std::move(weights));
  }

  void prepare(uint64_t seed, int threads, const std::atomic<bool>& cancelled) override {
    if (map_) draw_map(seed, threads, cancelled);
    if (!settings_.adaptive || cancelled) return;
    AdaptationSettings adaptation;
    adaptation.seed = seed;
    adaptation.threads = threads;
    choice_ = adapt(*scene_, settings_.paths, settings_.mutation, mutations_, choice_, adaptation,
                    cancelled);
  }

  double candidate(Rng& rng, RayCounts& rays) const override {
    return PathSeeds(*scene_, settings_.paths, settings_.mutation)
        .weigh(rng, rays, [](const Vec2&, double) {});
  }

  std::unique_ptr<Chain> start(const ChainId& id, Rng candidate, Rng choice) const override {
    RayCounts rays;
    PathState x =
        PathSeeds(*scene_, settings_.paths, settings_.mutation).pick(candidate, choice, rays);
    return std::make_unique<MltChain>(*scene_, settings_.mutation, mutations_, choice_, id,
                                      std::move(x));
  }

  std::unique_ptr<Chain> blank(const ChainId& id) const override {
    return std::make_unique<MltChain>(*scene_, settings_.mutation, mutations_, choice_, id,
                                      PathState());
  }

  std::vector<MutationStats> rows() const override {
    std::vector<MutationStats> rows;
    for (size_t i = 0; i < mutations_.size(); ++i)
      for (int k = 0; k <= longest_row; ++k) {
        MutationStats row;
        row.name = mutations_[i]->name();
        row.length = k;
        row.step_size = steps_[i];
        row.weight = choice_.weights(k)[i];
        rows.push_back(row);
      }
    return rows;
  }

  std::string save() const override {
    ByteWriter bytes;
    bytes.write(map_ ? map_->factors() : std::vector<double>());
    bytes.write<uint64_t>(choice_.rows());
    for (size_t k = 0; k < choice_.rows(); ++k) bytes.write(choice_.weights(static_cast<int>(k)));
    return bytes.take();
  }
  void load(const std::string& saved) override {
    ByteReader bytes(saved);
    std::vector<double> factors;
    bytes.read(factors);
    if (map_) map_->set_factors(std::move(factors));
    const uint64_t count = bytes.read<uint64_t>();
    std::vector<std::vector<double>> rows;
    for (uint64_t k = 0; k < count; ++k) {
      rows.emplace_back();
      bytes.read(rows.back());
      if (rows.back().size() != mutations_.size())
        throw RenderError("the saved state has other mutations");
    }
    if (rows.empty()) throw RenderError("the saved state has no mutations");
    choice_ = MutationChoice(std::move(rows));
    bytes.finish();
  }

 private:
  void add(const std::string& name, double largest_share) {
    MutationSettings settings = settings_.mutation;
    settings.largest_share = largest_share;
    mutations_.push_back(make_mutation(name, *scene_, settings));
    steps_.push_back(mutation_kind(name).perturbation ? largest_share : 0.0);
  }

  /// The first stage: a coarse image by bidirectional path tracing.
  void draw_map(uint64_t seed, int threads, const std::atomic<bool>& cancelled) {
    MutationSettings plain = settings_.mutation;
    plain.map = nullptr;
    constexpr uint64_t block = 256;
    std::vector<std::vector<std::pair<Vec2, double>>> seen(settings_.luminance_samples / block + 1);
    parallel_for(threads, seen.size(), [&](uint64_t b) {
      PathSeeds seeds(*scene_, settings_.paths, plain);
      RayCounts rays;
      for (uint64_t i = 0; i < block && !cancelled; ++i) {
        Rng rng(seed, Purpose::round, b * block + i);
        seeds.weigh(rng, rays, [&](const Vec2& raster, double weight) {
          seen[b].push_back({raster, weight});
        });
      }
    });
    for (const auto& samples : seen)
      for (const auto& [raster, weight] : samples) map_->add(raster, weight);
    map_->finish();
  }

  ScenePtr scene_;
  MltSettings settings_;
  std::unique_ptr<TargetMap> map_;
  Mutations mutations_;
  std::vector<double> steps_;
  MutationChoice choice_;
};

void MltChain::load(ByteReader& bytes) {
  rng_ = Rng(bytes.read<Rng::State>());
  step_ = bytes.read<uint64_t>();
  mlt::load(bytes, x_.path);
  stats_.load(bytes);
  if (x_.path.vertices.size() < 2) throw RenderError("the saved state has a chain without a path");
  evaluate(*scene_, *settings_, x_);
}

class MltIntegrator : public Integrator {
 public:
  explicit MltIntegrator(Params& params) : metropolis_(metropolis_settings(params)) {
    const PathSettings path = path_settings(params);
    settings_.paths.max_depth = settings_.mutation.max_depth = path.max_depth;
    settings_.paths.rr_depth = path.rr_depth;
    settings_.paths.hide_emitters = settings_.mutation.hide_emitters = path.hide_emitters;
    settings_.paths.strict_normals = settings_.mutation.strict_normals = path.strict_normals;
    settings_.mutation.near_specular = params.real_in("near_specular", 0, 1);
    if (params.boolean("manifold_perturbation"))
      params.fail("manifold_perturbation",
                  "is true, but this mutation does not exist yet; leave it out");
    settings_.two_stage = params.boolean("two_stage");
    settings_.luminance_samples = metropolis_.luminance_samples;
    direct_samples_ = static_cast<int>(params.integer_in("direct_samples", -1, 1 << 20));
    if (direct_samples_ >= 0) settings_.paths.min_depth = settings_.mutation.min_depth = 3;
    double sum = 0;
    bool chosen = false;  // by the user
    for (const MutationKind& kind : mutation_kinds()) {
      const double weight =
          params.boolean(kind.switch_name) ? params.real_in(kind.weight_name, 0, 1e9) : 0;
      if (weight > 0) settings_.weights.push_back({kind.name, weight});
      sum += weight;
      chosen = chosen || params.has(kind.weight_name);
    }
    settings_.adaptive = params.has("adaptive") ? params.boolean("adaptive") : !chosen;
    if (!(sum > 0)) params.fail("needs at least one mutation with a positive weight");
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    auto algorithm = std::make_unique<Mlt>(scene, settings_);
    SeparateDirect direct;
    if (direct_samples_ >= 0)
      direct = separate_direct(scene, seed, direct_samples_, settings_.paths.hide_emitters,
                               settings_.paths.strict_normals);
    return std::make_unique<MetropolisRendering>(std::move(scene), seed, metropolis_,
                                                 std::move(algorithm), std::move(direct));
  }
  void add(const ExtraMutation& extra) { settings_.extra.push_back(extra); }

 private:
  MetropolisSettings metropolis_;
  MltSettings settings_;
  int direct_samples_ = -1;
};

}  // namespace

IntegratorPtr with_mutations(const Integrator& integrator,
                             const std::vector<ExtraMutation>& extra) {
  const auto* mlt = dynamic_cast<const MltIntegrator*>(&integrator);
  if (!mlt) throw UsageError("'" + integrator.name() + "' has no mixture of mutations; mlt has");
  auto made = std::make_shared<MltIntegrator>(*mlt);
  for (const ExtraMutation& mutation : extra) made->add(mutation);
  return made;
}

Plugin integrator_mlt() {
  Schema schema;
  schema.family = "integrator";
  schema.name = "mlt";
  schema.doc =
      "Metropolis light transport in path space with Veach's mutations (Veach & Guibas 1997). One "
      "spp is "
      "one mutation per pixel.";
  schema.parameters = path_parameters();
  for (const Parameter& shared : metropolis_parameters()) schema.parameters.push_back(shared);
  for (const MutationKind& kind : mutation_kinds()) {
    schema.parameters.push_back(
        {kind.switch_name, ParamType::boolean, true, "Use the " + kind.doc});
    schema.parameters.push_back(
        {kind.weight_name, ParamType::real, kind.weight,
         "Weight of the " + kind.name + " mutation among those that suit a path."});
  }
  schema.parameters.push_back(
      {"near_specular", ParamType::real, 0.1,
       "Smooth vertices below this roughness count as specular in perturbations."});
  schema.parameters.push_back(
      {"adaptive", ParamType::boolean, true,
       "Let pilot chains find the weights and step sizes of the mutations; by default "
       "only if no weight is given."});
  schema.parameters.push_back(
      {"two_stage", ParamType::boolean, false,
       "Divide the target by a coarse image, so that dark regions get their share."});
  schema.parameters.push_back(
      {"direct_samples", ParamType::integer, int64_t{-1},
       "Render light of at most one reflection apart with this many samples per pixel; "
       "0 leaves it out, -1 leaves it to the chains."});
  schema.parameters.push_back(
      {"manifold_perturbation", ParamType::boolean, false, "Only false: it does not exist yet."});
  return {schema,
          [](Params& params) -> ObjectPtr { return std::make_shared<MltIntegrator>(params); }};
}

}  // namespace mlt
