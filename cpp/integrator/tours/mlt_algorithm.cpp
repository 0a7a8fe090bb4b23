#include "integrator/tours/mlt_algorithm.h"

#include "integrator/path_samples.h"
#include "integrator/tours/path_kernel.h"
#include "integrator/tours/path_tours.h"
#include "mutation/adaptation.h"
#include "rendering/coarse_image.h"

namespace mlt {
namespace {

/// The step of a second stage over that of the first.
constexpr double second_stage_share = 0.1;

/// Number of walks that look for the lights that the camera sees (CertainLight), at most.
constexpr uint64_t walks_to_lights = 50000;

/// In a pilot, where no pixel depends on it, a chain counts as found again after so many searches.
constexpr int most_searches_of_pilot = 1024;

/// A mutation's own parameter for its step size, and the values among which adaptation chooses.
struct StepSizeChoice {
  const char* parameter;
  double values[2];
};
constexpr StepSizeChoice step_size_choices[] = {{"largest_share", {0.02, 0.1}},
                                                {"step_size", {1. / 256, 1. / 32}}};

/// The choice of step sizes of a mutation; nullptr if it has no step size.
const StepSizeChoice* step_size_choice(const MutationPlugin& plugin) {
  for (const StepSizeChoice& choice : step_size_choices)
    if (plugin.schema.find(choice.parameter)) return &choice;
  return nullptr;
}

/// A second stage evaluates the density of the rejected path, proposed from another path. A
/// manifold walk may lead elsewhere from there, which its density does not account for.
bool can_be_retried(const MutationPlugin& plugin) {
  return plugin.has_step_size() && plugin.name() != "manifold";
}

class MltAlgorithm : public MetropolisAlgorithm {
 public:
  MltAlgorithm(ScenePtr scene, const MltSettings& settings)
      : settings_(settings), target_(std::move(scene), settings.rules, settings.near_specular) {
    std::vector<double> weights;
    for (const MixedMutation& mixed : settings_.mixture) {
      const auto supports = mutation_plugin(mixed.name).supports;
      if (supports && !supports(target_.scene()) && settings_.mixture.size() > 1) continue;
      for (const auto& [own, weight] : in_all_sizes(mixed)) {
        mutations_.push_back(make_mutation(mixed.name, target_, own));
        step_sizes_.push_back(step_size(mixed.name, own));
        second_stage_.push_back(settings_.delayed_rejection ? second_stage(mixed.name, own)
                                                            : nullptr);
        weights.push_back(weight);
      }
    }
    for (const ExtraMutation& extra : settings_.extra) {
      mutations_.push_back(extra.make(target_));
      step_sizes_.push_back(0);
      weights.push_back(extra.weight);
    }
    weights_ = std::make_shared<MixtureWeights>(std::move(weights));
  }

  void learn(double seconds) override {
    constexpr double least = 1 << 18, most = rays_of_lessons;
    lesson_rays_ = static_cast<uint64_t>(std::clamp(most * seconds, least, most));
    find_manifolds();
    if (!guide_) return;
    const auto hasty = std::make_shared<ManifoldGuide>(*guide_);
    hasty->set_most_searches(most_searches_of_pilot);
    target_.set_manifolds(hasty);
  }
  void look_around(double share, uint64_t seed, int threads,
                   const std::atomic<bool>& cancelled) override {
    walks_ = affordable(share, walks_to_lights);
    if (settings_.samples_beside)
      target_.leave_to_samples({scene(), target_.rules(), walks_, seed, threads, cancelled});
  }
  void prepare(const CoarseImage& coarse, uint64_t, int, const std::atomic<bool>&) override {
    if (settings_.two_stage) target_.set_map(coarse.map);
  }
  void set_weights(const ClampingWeights& weights) override { target_.set_weights(weights); }
  void adapt(double share, uint64_t seed, int threads,
             const std::atomic<bool>& cancelled) override {
    if (!settings_.adaptive) return;
    AdaptationSettings adaptation;
    adaptation.seed = seed;
    adaptation.threads = threads;
    adaptation.candidates = affordable(share, adaptation.candidates);
    adaptation.steps = static_cast<int>(affordable(share, adaptation.steps));
    weights_ = std::make_shared<MixtureWeights>(
        mlt::adapt(target_, mutations_, *weights_, adaptation, cancelled));
  }

  void end_pilot() override { target_.set_manifolds(guide_); }

  const Scene& scene() const override { return target_.scene(); }
  std::unique_ptr<Source> source() const override { return path_candidates(target_); }
  bool set_techniques(SampleTechniques techniques) override {
    if (techniques > SampleTechniques::path_tracing) return false;
    target_.set_techniques(techniques);
    return true;
  }
  std::string samples_name() const override {
    return target_.techniques() == SampleTechniques::path_tracing ? "path" : "bdpt";
  }
  std::unique_ptr<Source> sample_source() const override { return path_samples(target_); }
  std::unique_ptr<SampleTaker> sample_taker(const ClampingWeights& weights) const override {
    return path_sample_taker(target_, weights);
  }

  bool has_tours() const override { return true; }
  std::unique_ptr<StartingPaths> starting_paths() const override {
    return std::make_unique<StartingPaths>(target_);
  }
  std::unique_ptr<RenderChain> blank(const ChainId& id,
                                     const Allocation& allocation) const override {
    const double kappa0 = allocation.kappa0;
    TourRules rules{settings_.tour_length ? KillRate::constant(kappa0, *settings_.tour_length)
                                          : KillRate(kappa0),
                    allocation.steps_per_start};
    if (settings_.spark > 0)
      rules.steps_in_pixel =
          settings_.spark * (allocation.brightness + 2 * allocation.left) / kappa0;
    return std::make_unique<PathTours>(target_, mixture(), id, rules);
  }

  std::vector<MutationStats> rows() const override {
    std::vector<MutationStats> rows = path_kernel_rows(mutations_, *weights_);
    for (size_t i = 0; i < rows.size(); ++i) rows[i].step_size = step_sizes_[i / (longest_row + 1)];
    return rows;
  }

  std::string save() const override {
    ByteWriter bytes;
    bytes.write(target_.map() ? target_.map()->factors() : std::vector<double>());
    const CertainLight* certain = target_.certain_light();
    bytes.write(lesson_rays_);
    bytes.write(walks_);
    bytes.write(certain ? certain->cells() : std::vector<uint8_t>());
    bytes.write<uint64_t>(weights_->rows().size());
    for (const auto& row : weights_->rows()) bytes.write(row);
    return bytes.take();
  }
  void load(const std::string& saved) override {
    ByteReader bytes(saved);
    std::vector<double> factors;
    bytes.read(factors);
    bytes.read(lesson_rays_);
    find_manifolds();
    bytes.read(walks_);
    std::vector<uint8_t> cells;
    bytes.read(cells);
    const Raster& raster = scene().camera().raster();
    if (!cells.empty()) target_.leave_to_samples({raster, walks_, std::move(cells)});
    if (!factors.empty()) {
      TargetMap map = blank_image(raster);
      map.set_factors(std::move(factors));
      target_.set_map(std::move(map));
    }
    std::vector<std::vector<double>> rows(std::min<uint64_t>(bytes.read<uint64_t>(), 1 << 10));
    for (auto& row : rows) {
      bytes.read(row);
      if (row.size() != mutations_.size()) throw RenderError("the saved state has other mutations");
    }
    if (rows.empty()) throw RenderError("the saved state has no mutations");
    weights_ = std::make_shared<MixtureWeights>(std::move(rows));
    bytes.finish();
  }

 private:
  /// Learns which chains are searched for: alike for each render of the scene with as many rays.
  void find_manifolds() {
    if (settings_.manifolds) guide_ = learn_manifolds(scene(), target_.rules(), lesson_rays_);
    target_.set_manifolds(guide_);
  }
  /// The mutation as it is, or once for each step size that adaptation chooses from.
  std::vector<std::pair<MutationValues, double>> in_all_sizes(const MixedMutation& mixed) const {
    const StepSizeChoice* choice = step_size_choice(mutation_plugin(mixed.name));
    const auto is_given = [&](const auto& value) { return value.first == choice->parameter; };
    if (!settings_.adaptive || !choice ||
        std::any_of(mixed.values.begin(), mixed.values.end(), is_given))
      return {{mixed.values, mixed.weight}};
    std::vector<std::pair<MutationValues, double>> sizes;
    for (const double size : choice->values) {
      sizes.push_back({mixed.values, mixed.weight / std::size(choice->values)});
      sizes.back().first.push_back({choice->parameter, size});
    }
    return sizes;
  }

  /// A perturbation with the step reduced by second_stage_share, so that it is likely to be
  /// accepted.
  MutationPtr second_stage(const std::string& name, const MutationValues& own) const {
    const MutationPlugin& plugin = mutation_plugin(name);
    if (!can_be_retried(plugin)) return nullptr;
    const double size = second_stage_share * step_size(name, own);
    MutationValues smaller{{"largest_share", size}};
    for (const auto& value : own)
      if (value.first != "largest_share") smaller.push_back(value);
    return make_mutation(name, target_, smaller);
  }

  static double step_size(const std::string& name, const MutationValues& own) {
    const MutationPlugin& plugin = mutation_plugin(name);
    const StepSizeChoice* choice = step_size_choice(plugin);
    return choice ? own_parameters(plugin, own).real(choice->parameter) : 0;
  }

  PathMixture mixture() const { return {mutations_, weights_, second_stage_}; }

  MltSettings settings_;
  PathTarget target_;
  uint64_t lesson_rays_ = rays_of_lessons;
  uint64_t walks_ = 0;  ///< Camera walks that have looked for CertainLight.
  std::shared_ptr<const ManifoldGuide> guide_;
  Mutations mutations_;
  std::vector<double> step_sizes_;
  Mutations second_stage_;  ///< Mutations of the second stage, after a rejected proposal.
  std::shared_ptr<const MixtureWeights> weights_;
};

}  // namespace

std::unique_ptr<MetropolisAlgorithm> mlt_algorithm(ScenePtr scene, const MltSettings& settings) {
  return std::make_unique<MltAlgorithm>(std::move(scene), settings);
}

}  // namespace mlt
