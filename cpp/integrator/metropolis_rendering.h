// Rendering by Markov chains, with independent samples beside them: what all Metropolis integrators
// share. A render is a fixed number of chains and of sequences of samples, each with its own random
// numbers; a unit is some steps of one chain or some samples of one sequence, and these are visited
// in turn, so that every prefix of a render is a fair image. They form independent groups, each with
// its own bootstrap; GroupCombination tells how these add up.
#pragma once

#include "integrator/group_combination.h"
#include "integrator/integrator.h"
#include "integrator/metropolis_pilot.h"
#include "integrator/separate_direct.h"
#include "markov/bootstrap.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

namespace mlt {

struct MetropolisSettings {
  int chains = 1024;
  int64_t luminance_samples = 50000;
  std::optional<double> independent_share;  ///< Of the time; without, a pilot finds it.
};

class MetropolisRendering : public Rendering {
 public:
  /// The algorithm has been prepared, or will be loaded with the rendering.
  MetropolisRendering(ScenePtr scene, uint64_t seed, const MetropolisSettings& settings,
                      const Allocation& allocation, std::unique_ptr<MetropolisAlgorithm> algorithm,
                      SeparateDirect direct = {});

  void prepare(int threads, const std::atomic<bool>& cancelled) override;
  void run_unit(uint64_t unit) override;
  Image image() const override;
  GroupImage group(int index) const override;
  const Rendering* separate_direct() const override { return direct_.rendering.get(); }
  void add_stats(Stats& stats) const override;
  std::string save(const Task& task, Content content) const override;
  void load(const std::string& state) override;

 private:
  /// A unit ends within a fraction of a second, however few chains share a large image.
  static constexpr uint64_t most_steps_per_unit = 4096;

  /// A share of the render: a chain, or a sequence of samples.
  struct Share {
    int group = 0, number = 0;
    std::unique_ptr<RenderChain> chain;
    double brightness = 0;  ///< Sum of L* of what the chain has recorded.
    std::unique_ptr<IndependentSamples> samples;
    uint64_t units = 0;  ///< That are done.
    mutable std::mutex mutex;
    std::condition_variable turn;
  };
  struct Group {
    SampleSums bootstrap;
    std::atomic<uint64_t> steps{0};
  };

  double pixels() const { return scene_->camera().raster().pixels(); }
  int chains_of(int group) const;
  ChainId chain_id(const Share& share) const;
  SplatFilm make_film() const;
  void render_direct(int threads, const std::atomic<bool>& cancelled);
  void divide_samples();
  std::unique_ptr<IndependentSamples> samples_of(int group, int number) const;
  void lay_out();
  std::vector<std::vector<uint32_t>> run_bootstrap(const Candidates& candidates, int threads,
                                                   const std::atomic<bool>& cancelled);
  GroupCombination combination() const;
  Image image(GroupScales scales) const;
  ChainStats sum_of_stats(StuckChain& stuck) const;
  std::unique_ptr<Share> read_share(const Share& like, ByteReader& bytes) const;
  std::string save_prepared() const;
  void load_prepared(const std::string& prepared);

  MetropolisSettings settings_;
  Allocation allocation_;
  std::unique_ptr<MetropolisAlgorithm> algorithm_;
  SeparateDirect direct_;
  SplatFilm chain_film_, sample_film_;
  /// Group after group: the film of one group then stays in the cache while its chains advance.
  std::vector<std::unique_ptr<Share>> shares_;
  std::array<Group, group_count> groups_;
  uint64_t steps_per_unit_, samples_per_unit_ = 0;
  int sequences_ = 0;  ///< Of samples, in each group.
  RayCounts bootstrap_rays_;
};

}  // namespace mlt
