// Rendering by Markov chains: what all Metropolis integrators share. A render is a fixed number of
// chains, each with its own random stream; a unit is some steps of one chain, and chains are
// visited in turn, so that every prefix of a render is a fair image. Chains form independent
// groups, each with its own bootstrap and its own estimate of b.
#pragma once

#include "base/bytes.h"
#include "base/rng.h"
#include "image/splat_film.h"
#include "integrator/separate_direct.h"
#include "markov/step.h"
#include "path/ray_counts.h"

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

namespace mlt {

/// Where a chain leaves what it visits: RGB / L* at a raster position, times an expected weight. Each
/// splat waits for the next one, while its pixel comes from memory.
class ChainRecorder {
 public:
  ChainRecorder(SplatFilm& film, int group) : film_(&film), group_(group) {}
  void record(const Vec2& raster, const Color& rgb_per_target, double weight) {
    film_->prefetch(group_, raster);
    flush();
    raster_ = raster;
    color_ = rgb_per_target * weight;
  }
  void flush() {
    if (!is_black(color_)) film_->add(group_, raster_, color_);
    color_ = Color(0);
  }

 private:
  SplatFilm* film_;
  int group_;
  Vec2 raster_{0};
  Color color_{0};
};

/// Records the states of a chain, each once: the weights of the current state add up until the chain
/// leaves it. A State has raster, rgb and target.
template <class State>
class StepRecorder {
 public:
  StepRecorder(ChainRecorder& recorder, const State& x) : recorder_(&recorder), x_(&x) {}

  /// As metropolis_step calls it.
  void operator()(const State& state, double weight) {
    (&state == x_ ? weight_x_ : weight_y_) += weight;
  }

  /// After a step; on acceptance `other` is the state that x has left, otherwise the proposal.
  void settle(const StepResult& result, const State& other) {
    if (result.accepted >= 0) std::swap(weight_x_, weight_y_);
    record(other, weight_y_);
    weight_y_ = 0;
  }
  /// Records what the current state has gathered.
  void finish() {
    record(*x_, weight_x_);
    weight_x_ = 0;
    recorder_->flush();
  }

 private:
  void record(const State& state, double weight) {
    // A chain may start from a path whose light rounding has taken away.
    if (weight > 0 && state.target > 0)
      recorder_->record(state.raster, state.rgb / state.target, weight);
  }

  ChainRecorder* recorder_;
  const State* x_;
  double weight_x_ = 0, weight_y_ = 0;
};

/// What a chain tells about its steps; sums, so that chains can be merged.
struct ChainStats {
  struct Row {
    uint64_t proposed = 0, generated = 0, accepted = 0, rays = 0;
    double acceptance = 0, image_distance = 0;

    Row& operator+=(const Row& other);
  };
  /// The longest run of rejections.
  struct Stuck {
    uint64_t rejections = 0;
    Vec2 raster{0};
    std::string signature;
  };
  std::vector<Row> rows;  ///< As MetropolisAlgorithm::rows lists them.
  RayCounts rays;
  uint64_t invalid = 0;
  uint64_t run = 0;  ///< Rejections in a row up to now.
  Stuck longest;

  /// Counts one step; `moved` is the distance on the image if it was accepted.
  void count(Row& row, const StepResult& result, bool generated, double moved);
  void save(ByteWriter& bytes) const;
  void load(ByteReader& bytes);
};

/// One Markov chain.
class Chain {
 public:
  virtual ~Chain() = default;
  virtual void advance(uint64_t steps, ChainRecorder& recorder) = 0;
  virtual const ChainStats& stats() const = 0;
  virtual void save(ByteWriter& bytes) const = 0;
  virtual void load(ByteReader& bytes) = 0;
};

/// Which chain it is: by its group, and by its number in the group.
struct ChainId {
  uint64_t seed;
  int group, number, count;
  Purpose purpose = Purpose::chain;

  Rng rng() const { return Rng(seed, purpose, (uint64_t(group) << 32) | uint32_t(number)); }
};

/// What distinguishes one Metropolis integrator from another.
class MetropolisAlgorithm {
 public:
  virtual ~MetropolisAlgorithm() = default;

  /// Draws a candidate for the start of a chain: returns its weight L* / p.
  virtual double candidate(Rng& rng, RayCounts& rays) const = 0;
  /// Starts a chain from the candidate that the same stream gave; `choice` is there to choose one of
  /// several paths that the candidate consists of.
  virtual std::unique_ptr<Chain> start(const ChainId& id, Rng candidate, Rng choice) const = 0;
  /// A chain without a state, to be loaded from bytes.
  virtual std::unique_ptr<Chain> blank(const ChainId& id) const = 0;
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
    std::unique_ptr<Chain> chain;
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
  std::vector<std::vector<double>> candidate_weights(uint64_t per_group, int threads,
                                                     const std::atomic<bool>& cancelled);
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
