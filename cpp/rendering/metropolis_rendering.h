// Rendering by Markov chains, with independent samples beside them: the common part of all
// Metropolis integrators. Chains and samples find the same paths, weighted by ClampingWeights.
//
// A render is a fixed number of chains, each with its own random stream; a unit is some steps of
// one chain or of a few that advance together, and these are visited in turn. They form independent
// groups, each with its own bootstrap, which GroupEstimator adds up. The samples are a
// rendering of their own, whose units are interleaved with those of the chains, so that every
// prefix of a render is a fair image.
#pragma once

#include "markov/bootstrap.h"
#include "rendering/group_estimator.h"
#include "rendering/interleaving.h"
#include "rendering/metropolis_algorithm.h"
#include "rendering/sampled_rendering.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

namespace mlt {

/// Direct light that is added to the image of the chains.
struct SeparateDirect {
  std::unique_ptr<Rendering> rendering;  ///< nullptr: there is none.
  double spp = 0;
};

struct MetropolisSettings {
  int chains = 128;
  int64_t luminance_samples = 50000;
  /// Samples' share of time, which becomes Allocation::share; default: by a pilot.
  std::optional<double> independent_share;
  std::optional<SampleTechniques> techniques;  ///< Techniques of samples; default: by a pilot.
  std::optional<double> steps_per_start;       ///< Steps of tours per sample that they start from.
  bool parts = false;              ///< Whether to keep the images of samples and chains as layers.
  bool only_camera_walks = false;  ///< See warn_of_hidden_lights.
  LightLayerSettings light;        ///< Only where chains and samples tell the layers of paths.
};

class MetropolisRendering : public Rendering {
 public:
  MetropolisRendering(ScenePtr scene, uint64_t seed, const MetropolisSettings& settings,
                      std::unique_ptr<MetropolisAlgorithm> algorithm, SeparateDirect direct = {});

  void prepare(int threads, const std::atomic<bool>& cancelled) override;
  Memory memory(double spp) const override;
  void run_unit(uint64_t unit) override;
  Image image(int layer = all_light) const override;
  /// The image of one group of chains.
  GroupImage group(int index, int layer = all_light) const override;
  std::vector<const Rendering*> parts() const override;
  Image common_error(int layer = all_light) const override;
  std::vector<NamedImage> layers() const override;
  void add_stats(Stats& stats) const override;
  std::string save(const Task& task, Content content) const override;
  void load(const std::string& state) override;

 private:
  /// The most steps of chains in a turn, so that it ends within about a second for any image size.
  static constexpr double most_steps_per_turn = 1 << 19;

  /// Chains of a group that advance together: a strand of the render, after those of the samples.
  struct ChainBatch {
    int group, first;  ///< Number of its first chain in the group.
    std::vector<std::unique_ptr<RenderChain>> chains;
    double brightness = 0;  ///< Sum of L* of the states that they have recorded.
    uint64_t units = 0;     ///< Units that are done.
    mutable std::mutex mutex;
    std::condition_variable turn;
  };
  struct Group {
    double b = 0;
    SampleSums bootstrap;
    std::atomic<uint64_t> steps{0};
  };

  double pixels() const { return scene_->camera().raster().pixels(); }
  int chains_of(int group) const;
  ChainId chain_id(const ChainBatch& strand, size_t chain) const;
  std::unique_ptr<RenderChain> blank_chain(const ChainBatch& team, size_t chain) const;
  uint64_t chain_count() const;
  uint64_t sample_strands() const { return samples_ ? uint64_t{group_count} : 0; }
  void render_direct(int threads, const std::atomic<bool>& cancelled);
  bool prepare_chains(int threads, const std::atomic<bool>& late,
                      const std::atomic<bool>& cancelled);
  void do_without_chains();
  double affordable_share(const std::atomic<bool>& cancelled);
  Allocation run_pilot(int threads, const std::atomic<bool>& cancelled);
  std::vector<std::vector<uint32_t>> run_bootstrap(const Candidates& candidates, int threads,
                                                   const std::atomic<bool>& cancelled);
  void start_tours();
  void start_chains(int threads, const std::atomic<bool>& cancelled);
  uint64_t passes_per_turn() const;
  void lay_out();
  void form_teams(int group);
  void lay_out_units();
  void run_batch(uint64_t number);
  const SplatFilm& film_of(int layer) const {
    return layer == all_light ? film_ : *light_films_[layer];
  }
  Image chain_image(GroupWeights scales, int layer) const;
  /// The sums of each group; the bootstrap of tours consists of the samples that they start from.
  std::vector<GroupProgress> progress() const;
  GroupEstimator group_estimator() const;
  void add_level(Stats& stats) const;
  ChainStats sum_of_stats(StuckChain& stuck) const;
  std::string save_prepared() const;
  void load_prepared(const std::string& prepared);
  void save_chains(const Strands& strands, Content content, ByteWriter& bytes) const;
  void load_chains(ByteReader& bytes);

  MetropolisSettings settings_;
  double affordable_share_ = 1;
  Allocation allocation_;
  std::unique_ptr<MetropolisAlgorithm> algorithm_;
  SeparateDirect direct_;
  std::unique_ptr<SampledRendering> samples_;  ///< nullptr: there are none.
  SplatFilm film_;
  FilmRecorder::Films light_films_;
  /// The chains of groups that have found light, group after group: the film of one group then
  /// stays in the cache while its chains advance.
  std::vector<std::unique_ptr<ChainBatch>> teams_;
  std::array<Group, group_count> groups_;
  uint64_t steps_per_unit_ = 1;
  Interleaving interleaving_;
  RayCounts bootstrap_rays_;
};

}  // namespace mlt
