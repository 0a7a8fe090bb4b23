#include "integrator/mlt_algorithm.h"

#include "integrator/path_kernel.h"
#include "integrator/path_source.h"
#include "mutation/adaptation.h"

namespace mlt {
namespace {

/// Step sizes among which adaptation chooses: largest moves, as shares of the image's diagonal.
constexpr double adaptive_shares[] = {0.02, 0.1};

/// Moves one chain of a group; its fresh lens subpaths are stratified over all chains of the group.
class GroupMixture : public PathKernel {
 public:
  GroupMixture(const PathTarget& target, const PathMixture& mixture, const ChainId& id)
      : PathKernel(target, mixture),
        id_(id),
        key_(mix_bits(id.seed ^ mix_bits(static_cast<uint64_t>(id.group)))) {}

  Transition propose(const PathState& x, std::array<PathState, 1>& y, size_t stage, Rng& rng) {
    aids().stratified = {static_cast<uint32_t>(id_.number), static_cast<uint32_t>(id_.count),
                         mix_bits(key_ + step_++)};
    return PathKernel::propose(x, y, stage, rng);
  }

  void save(ByteWriter& bytes, const PathState& x) const {
    bytes.write(step_);
    PathKernel::save(bytes, x);
  }
  void load(ByteReader& bytes, PathState& x) {
    step_ = bytes.read<uint64_t>();
    PathKernel::load(bytes, x);
  }

 private:
  ChainId id_;
  uint64_t key_;  ///< Names the steps of the group's chains.
  uint64_t step_ = 0;
};

class MltAlgorithm : public MetropolisAlgorithm {
 public:
  MltAlgorithm(ScenePtr scene, const MltSettings& settings)
      : settings_(settings), target_(std::move(scene), settings.rules, settings.near_specular) {
    std::vector<double> weights;
    for (const MixedMutation& mixed : settings_.mixture)
      for (const auto& [own, weight] : in_all_sizes(mixed)) {
        mutations_.push_back(make_mutation(mixed.name, target_, own));
        step_sizes_.push_back(step_size(mixed.name, own));
        weights.push_back(weight);
      }
    for (const ExtraMutation& extra : settings_.extra) {
      mutations_.push_back(extra.make(target_));
      step_sizes_.push_back(0);
      weights.push_back(extra.weight);
    }
    weights_ = std::make_shared<MixtureWeights>(std::move(weights));
  }

  void prepare(const CoarseImage& coarse, uint64_t seed, int threads,
               const std::atomic<bool>& cancelled) override {
    if (settings_.two_stage) target_.set_map(coarse.map);
    if (!settings_.adaptive || cancelled) return;
    AdaptationSettings adaptation;
    adaptation.seed = seed;
    adaptation.threads = threads;
    weights_ = std::make_shared<MixtureWeights>(
        adapt(target_, mutations_, *weights_, adaptation, cancelled));
  }

  std::unique_ptr<Source> source() const override { return std::make_unique<PathSource>(target_); }

  std::unique_ptr<RenderChain> start(const ChainId& id, Rng candidate, Rng choice) const override {
    return chain(id, target_.seeds().pick(candidate, choice));
  }
  std::unique_ptr<RenderChain> blank(const ChainId& id) const override { return chain(id, {}); }

  std::vector<MutationStats> rows() const override {
    std::vector<MutationStats> rows = path_kernel_rows(mutations_, *weights_);
    for (size_t i = 0; i < rows.size(); ++i) rows[i].step_size = step_sizes_[i / (longest_row + 1)];
    return rows;
  }

  std::string save() const override {
    ByteWriter bytes;
    bytes.write(target_.map() ? target_.map()->factors() : std::vector<double>());
    bytes.write<uint64_t>(weights_->rows().size());
    for (const auto& row : weights_->rows()) bytes.write(row);
    return bytes.take();
  }
  void load(const std::string& saved) override {
    ByteReader bytes(saved);
    std::vector<double> factors;
    bytes.read(factors);
    if (settings_.two_stage) {
      TargetMap map = blank_image(target_.scene().camera().raster());
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
  /// The mutation as it is, or once for each step size that adaptation chooses from.
  std::vector<std::pair<MutationValues, double>> in_all_sizes(const MixedMutation& mixed) const {
    const auto has_size = [](const auto& value) { return value.first == "largest_share"; };
    if (!settings_.adaptive || !mutation_plugin(mixed.name).has_step_size() ||
        std::any_of(mixed.values.begin(), mixed.values.end(), has_size))
      return {{mixed.values, mixed.weight}};
    std::vector<std::pair<MutationValues, double>> sizes;
    for (const double share : adaptive_shares) {
      sizes.push_back({mixed.values, mixed.weight / std::size(adaptive_shares)});
      sizes.back().first.push_back({"largest_share", share});
    }
    return sizes;
  }

  static double step_size(const std::string& name, const MutationValues& own) {
    const MutationPlugin& plugin = mutation_plugin(name);
    return plugin.has_step_size() ? own_parameters(plugin, own).real("largest_share") : 0;
  }

  std::unique_ptr<RenderChain> chain(const ChainId& id, PathState start) const {
    return std::make_unique<RecordedChain<GroupMixture>>(
        GroupMixture(target_, {mutations_, weights_}, id), id, std::move(start));
  }

  MltSettings settings_;
  PathTarget target_;
  Mutations mutations_;
  std::vector<double> step_sizes_;
  std::shared_ptr<const MixtureWeights> weights_;
};

}  // namespace

std::unique_ptr<MetropolisAlgorithm> mlt_algorithm(ScenePtr scene, const MltSettings& settings) {
  return std::make_unique<MltAlgorithm>(std::move(scene), settings);
}

}  // namespace mlt
