// mlt: Metropolis light transport in path space. E. Veach and L. Guibas, "Metropolis light transport",
// SIGGRAPH 1997; Veach 1997, ch. 11.
#include "base/registry.h"
#include "integrator/metropolis_params.h"
#include "integrator/metropolis_rendering.h"
#include "integrator/path_params.h"
#include "math/permutation.h"
#include "mutation/kinds.h"
#include "mutation/mixture.h"
#include "path/bidirectional.h"
#include "path/samplers.h"

namespace mlt {
namespace {

struct MltSettings {
  BidirectionalSettings paths;
  MutationSettings mutation;
  std::vector<std::pair<std::string, double>> weights;  ///< Of each mutation, by name.
};

constexpr int longest_counted = 16;  // longer paths share a row of the statistics

class MltChain : public Chain {
 public:
  MltChain(const Scene& scene, const MutationSettings& settings, const Mutations& mutations,
           const MutationChoice& choice, const ChainId& id, LightPath start)
      : scene_(&scene),
        settings_(&settings),
        mutations_(&mutations),
        choice_(&choice),
        id_(id),
        rng_(id.rng()),
        x_(std::move(start)) {
    stats_.rows.resize(mutations.size() * (longest_counted + 1));
  }

  void advance(uint64_t steps, const ChainRecorder& recorder) override {
    MutationMixture kernel(*mutations_, *choice_, stats_.rays);
    StepRecorder<LightPath> record(recorder, x_);
    for (uint64_t i = 0; i < steps; ++i, ++step_) {
      kernel.set_stratified_raster(round_raster());
      const Vec2 from = x_.raster;
      const int edges = x_.edges();
      const uint64_t rays_before = stats_.rays.intersect + stats_.rays.occluded;
      const StepResult result = metropolis_step(x_, y_, kernel, rng_, record);
      record.settle(result, y_[0]);
      ChainStats::Row& row = stats_.rows[kernel.chosen() * (longest_counted + 1) + std::min(edges, longest_counted)];
      stats_.count(row, result, kernel.generated(), glm::length(x_.raster - from));
      row.rays += stats_.rays.intersect + stats_.rays.occluded - rays_before;
      if (stats_.run > stats_.longest.rejections && stats_.run % 64 == 0)
        stats_.longest = {stats_.run, x_.raster, signature()};
    }
    record.finish();
  }

  const ChainStats& stats() const override { return stats_; }

  void save(ByteWriter& bytes) const override {
    bytes.write(rng_.state());
    bytes.write(step_);
    bytes.write(x_.path.vertices);
    bytes.write(x_.path.time);
    stats_.save(bytes);
  }
  void load(ByteReader& bytes) override;

 private:
  std::string signature() const {
    std::string letters = "L";
    for (int i = 1; i < x_.edges(); ++i) letters += x_.specular[i] ? 'S' : 'D';
    return letters + "E";
  }

  /// The image position of this chain among those of all chains of the group in this step.
  Vec2 round_raster() const {
    const uint64_t key = mix_bits(mix_bits(id_.seed ^ mix_bits(static_cast<uint64_t>(id_.group))) + step_);
    return scene_->camera().raster().sample(stratified_point(id_.number, id_.count, key));
  }

  const Scene* scene_;
  const MutationSettings* settings_;
  const Mutations* mutations_;
  const MutationChoice* choice_;
  ChainId id_;
  Rng rng_;
  uint64_t step_ = 0;
  LightPath x_;
  std::array<LightPath, 1> y_;
  ChainStats stats_;
};

class Mlt : public MetropolisAlgorithm {
 public:
  Mlt(ScenePtr scene, const MltSettings& settings)
      : scene_(std::move(scene)), settings_(settings), choice_(std::vector<double>()) {
    std::vector<double> weights;
    for (const auto& [name, weight] : settings.weights) {
      mutations_.push_back(make_mutation(name, *scene_, settings.mutation));
      weights.push_back(weight);
    }
    choice_ = MutationChoice(std::move(weights));
  }

  double candidate(Rng& rng, RayCounts& rays) const override {
    Bidirectional paths(*scene_, settings_.paths);
    double sum = 0;
    sample(paths, rng, rays, [&](const Connection&, double weight) { sum += weight; });
    return sum;
  }

  /// Chooses one of the candidate's paths in proportion to its weighted L*.
  std::unique_ptr<Chain> start(const ChainId& id, Rng candidate, Rng choice) const override {
    Bidirectional paths(*scene_, settings_.paths);
    RayCounts rays;
    LightPath x;
    double sum = 0;
    sample(paths, candidate, rays, [&](const Connection& connection, double weight) {
      sum += weight;
      if (choice.next() * sum < weight) paths.assemble(connection, x.path);
    });
    evaluate(*scene_, settings_.mutation, x);
    return std::make_unique<MltChain>(*scene_, settings_.mutation, mutations_, choice_, id, std::move(x));
  }

  std::unique_ptr<Chain> blank(const ChainId& id) const override {
    return std::make_unique<MltChain>(*scene_, settings_.mutation, mutations_, choice_, id, LightPath());
  }

  std::vector<MutationStats> rows() const override {
    std::vector<MutationStats> rows;
    for (const auto& mutation : mutations_)
      for (int k = 0; k <= longest_counted; ++k) {
        rows.push_back({mutation->name()});
        rows.back().length = k;
      }
    return rows;
  }

 private:
  template <class Found>
  void sample(Bidirectional& paths, Rng& rng, RayCounts& rays, Found&& found) const {
    RandomSampler sampler(rng);
    paths.sample(scene_->camera().raster().sample(sampler.next2()), sampler, rays);
    paths.connect_all(rays, [&](const Connection& c) {
      const double weight = target_luminance(c.contribution) * c.weight;
      if (std::isfinite(weight) && weight > 0) found(c, weight);
    });
  }

  ScenePtr scene_;
  MltSettings settings_;
  Mutations mutations_;
  MutationChoice choice_;
};

void MltChain::load(ByteReader& bytes) {
  rng_ = Rng(bytes.read<Rng::State>());
  step_ = bytes.read<uint64_t>();
  bytes.read(x_.path.vertices);
  x_.path.time = bytes.read<double>();
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
      params.fail("manifold_perturbation", "is true, but this mutation does not exist yet; leave it out");
    double sum = 0;
    for (const MutationKind& kind : mutation_kinds()) {
      const double weight = params.boolean(kind.switch_name) ? params.real_in(kind.weight_name, 0, 1e9) : 0;
      if (weight > 0) settings_.weights.push_back({kind.name, weight});
      sum += weight;
    }
    if (!(sum > 0)) params.fail("needs at least one mutation with a positive weight");
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    auto algorithm = std::make_unique<Mlt>(scene, settings_);
    return std::make_unique<MetropolisRendering>(std::move(scene), seed, metropolis_, std::move(algorithm));
  }

 private:
  MetropolisSettings metropolis_;
  MltSettings settings_;
};

}  // namespace

Plugin integrator_mlt() {
  Schema schema;
  schema.family = "integrator";
  schema.name = "mlt";
  schema.doc =
      "Metropolis light transport in path space with Veach's mutations (Veach & Guibas 1997). One spp is "
      "one mutation per pixel.";
  schema.parameters = path_parameters();
  for (const Parameter& shared : metropolis_parameters()) schema.parameters.push_back(shared);
  for (const MutationKind& kind : mutation_kinds()) {
    schema.parameters.push_back({kind.switch_name, ParamType::boolean, true, "Use the " + kind.doc});
    schema.parameters.push_back({kind.weight_name, ParamType::real, kind.weight,
                                 "Weight of the " + kind.name + " mutation among those that suit a path."});
  }
  schema.parameters.push_back({"near_specular", ParamType::real, 0.1,
                               "Smooth vertices below this roughness count as specular in perturbations."});
  schema.parameters.push_back({"manifold_perturbation", ParamType::boolean, false, "Only false: it does not exist yet."});
  return {schema, [](Params& params) -> ObjectPtr { return std::make_shared<MltIntegrator>(params); }};
}

}  // namespace mlt
