// Rendering by Markov chains: what all Metropolis integrators share. A render is a fixed number of
// chains, each with its own random stream; a unit is some steps of one chain, and chains
// are visited in turn, so that every prefix of a render is a fair image. Chains form independent
// groups, each with its own bootstrap and its own estimate of b.
#pragma once

#include "integrator/integrator.h"
#include "integrator/metropolis_chain.h"
#include "integrator/separate_direct.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

namespace mlt {

/// What distinguishes one Metropolis integrator from another.
class MetropolisAlgorithm {
 public:
  virtual ~MetropolisAlgorithm() = default;

  /// Draws candidates for the starts of chains, and keeps its memory from one to the next.
  class Source {
   public:
    virtual ~Source() = default;
    /// Draws a candidate; returns its weight L* / p.
    virtual double weigh(Rng& rng) = 0;
    virtual const RayCounts& rays() const = 0;
  };
  virtual std::unique_ptr<Source> source() const = 0;
  /// Starts a chain from the candidate that the same stream gave; `choice` is there to choose one
  /// of several paths that the candidate consists of.
  virtual std::unique_ptr<RenderChain> start(const ChainId& id, Rng candidate,
                                             Rng choice) const = 0;
  /// A chain without a state, to be loaded from bytes.
  virtual std::unique_ptr<RenderChain> blank(const ChainId& id) const = 0;
  /// Name and path length of each row of the statistics.
  virtual std::vector<MutationStats> rows() const = 0;
  /// Called once before the bootstrap, to prepare whatever is to be known by then.
  virtual void prepare(uint64_t /*seed*/, int /*threads*/, const std::atomic<bool>& /*cancelled*/) {
  }
  virtual void add_stats(Stats& /*stats*/) const {}
  virtual std::string save() const { return ""; }
  virtual void load(const std::string& /*bytes*/) {}
};

struct MetropolisSettings {
  int chains = 1024;
  int64_t luminance_samples = 100000;
};

class MetropolisRendering : public Rendering {
 public:
  MetropolisRendering(ScenePtr scene, uint64_t seed, const MetropolisSettings& settings,
                      std::unique_ptr<MetropolisAlgorithm> algorithm, SeparateDirect direct = {});

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

  /// A share of the render.
  struct ChainShare {
    int group = 0, number = 0;
    std::unique_ptr<RenderChain> chain;
    uint64_t units = 0;  ///< That are done.
    mutable std::mutex mutex;
    std::condition_variable turn;
  };
  struct Group {
    double b = 0, b_error = 0;
    std::atomic<uint64_t> steps{0};
  };

  double pixels() const { return scene_->camera().raster().pixels(); }
  int chains_of(int group) const;
  ChainId chain_id(const ChainShare& share) const;
  void render_direct(int threads, const std::atomic<bool>& cancelled);
  void lay_out();
  bool begun(const Group& group) const { return group.steps > 0 || group.b == 0; }
  double scale_of(const Group& group) const;
  ChainStats sum_of_stats(StuckChain& stuck) const;
  std::string save_prepared() const;
  void load_prepared(const std::string& prepared);

  MetropolisSettings settings_;
  std::unique_ptr<MetropolisAlgorithm> algorithm_;
  SeparateDirect direct_;
  SplatFilm film_;
  /// The chains of groups that have found light, group after group: the film of one group then
  /// stays in the cache while its chains advance.
  std::vector<std::unique_ptr<ChainShare>> chains_;
  std::array<Group, group_count> groups_;
  uint64_t steps_per_unit_;
  RayCounts bootstrap_rays_;
};

}  // namespace mlt
