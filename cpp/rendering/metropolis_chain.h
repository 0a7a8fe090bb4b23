// Chains that render: the states that they visit are recorded in a film, and the outcomes of their
// steps are counted.
#pragma once

#include "base/bytes.h"
#include "base/error.h"
#include "base/rng.h"
#include "image/splat_film.h"
#include "markov/chain.h"
#include "markov/clamping_weights.h"
#include "math/weight_sums.h"
#include "path/light_layers.h"
#include "path/ray_counts.h"
#include "rendering/stats.h"

#include <memory>
#include <string>
#include <vector>

namespace mlt {

/// Records the states that chains visit.
class ChainRecorder {
 public:
  virtual ~ChainRecorder() = default;
  /// Records RGB / T of a state, its expected weight, its T / P (see ClampingWeights), and its
  /// layers_of().
  virtual void record(const Vec2& raster, const Color& rgb_per_target, double weight,
                      double target_over_density, LayerMask layers) = 0;
  virtual LayerMask layers_of(const Path& /*path*/) { return 0; }
  /// Whether it keeps the exposures of the shutter apart.
  virtual bool tells_exposures() const { return false; }
  /// Whether record() uses T / P.
  virtual bool wants_density() const { return true; }
  /// Called when a chain pauses.
  virtual void flush() {}
};

/// Records states on a film with their weights w2. Each splat waits for the next one, while its
/// pixel comes from memory.
class FilmRecorder : public ChainRecorder {
 public:
  using Films = std::vector<std::unique_ptr<SplatFilm>>;

  /// `light_films`: one for each of the layers of light.
  FilmRecorder(SplatFilm& film, const LightLayers* light, const Films& light_films, int group,
               const ClampingWeights& weights)
      : film_(&film),
        finder_(light),
        light_films_(&light_films),
        group_(group),
        weights_(&weights) {}
  LayerMask layers_of(const Path& path) override { return finder_.of(path); }
  bool tells_exposures() const override { return finder_.tells_exposures(); }
  void record(const Vec2& raster, const Color& rgb_per_target, double weight,
              double target_over_density, LayerMask layers) override {
    for (int i = 0; i < film_->splat_rows(); ++i)
      __builtin_prefetch(film_->splat_row(group_, raster, i), 1);
    flush();
    raster_ = raster;
    layers_ = layers;
    color_ = rgb_per_target * (weight * weights_->of_chain(target_over_density));
    brightness_ += target_luminance(color_);
  }
  void flush() override {
    if (is_black(color_)) return;
    film_->add(group_, raster_, color_);
    for_each_layer(layers_, [&](int i) { (*light_films_)[i]->add(group_, raster_, color_); });
    color_ = Color(0);
  }
  bool wants_density() const override { return weights_->threshold() > 0; }
  /// Sum of L* of the recorded states.
  double brightness() const { return brightness_; }

 private:
  SplatFilm* film_;
  LightLayers::Finder finder_;
  const Films* light_films_;
  int group_;
  const ClampingWeights* weights_;
  Vec2 raster_{0};
  Color color_{0};
  LayerMask layers_ = 0;
  double brightness_ = 0;
};

/// Records the states of a chain, each once: the weights of the current state add up until the
/// chain leaves it.
template <class Kernel>
class StepRecorder {
  using State = typename Kernel::State;
  using Others = std::array<State, Kernel::stages>;

 public:
  /// `others` is the scratch space of the steps.
  StepRecorder(ChainRecorder& recorder, Kernel& kernel, const State& x, const Others& others)
      : recorder_(&recorder), kernel_(&kernel), x_(&x), others_(&others) {}

  /// Called by metropolis_step for each state.
  void operator()(const State& state, double weight) {
    (&state == x_ ? weight_x_ : weights_[&state - others_->data()]) += weight;
  }

  /// To be called after a step: records the states that the chain has left.
  void settle(const StepResult& result) {
    weights_[0] += kernel_->proposal_weight();
    if (result.accepted >= 0) std::swap(weight_x_, weights_[result.accepted]);
    for (size_t stage = 0; stage < Kernel::stages; ++stage)
      record((*others_)[stage], weights_[stage]);
    weights_ = {};
  }
  /// Records the accumulated weight of the current state.
  void finish() {
    record(*x_, weight_x_);
    weight_x_ = 0;
    recorder_->flush();
  }

 private:
  void record(const State& state, double weight) {
    // A chain may start from a path whose light rounding has taken away.
    if (weight > 0 && state.target > 0) kernel_->record(*recorder_, state, weight);
  }

  ChainRecorder* recorder_;
  Kernel* kernel_;
  const State* x_;
  const Others* others_;
  double weight_x_ = 0;
  std::array<double, Kernel::stages> weights_{};
};

/// Statistics of the steps of a chain; sums, so that chains can be merged.
struct ChainStats {
  struct Row {
    uint64_t proposed = 0, generated = 0, accepted = 0, rays = 0;
    double acceptance = 0, image_distance = 0;
    /// Walks of mutations that failed, and walks that could not be reversed.
    uint64_t failed_walks = 0, failed_returns = 0;

    Row& operator+=(const Row& other);
  };
  /// The longest run of rejections.
  struct Stuck {
    uint64_t rejections = 0;
    Vec2 raster{0};
    std::string signature;
  };
  std::vector<Row> rows;  ///< In the order of MetropolisAlgorithm::rows.
  RayCounts rays;
  uint64_t invalid = 0;
  uint64_t run = 0;  ///< Rejections in a row up to now.
  Stuck longest;
  uint64_t tours = 0, longest_tour = 0;  ///< Tours, and steps of the longest.

  /// Counts one step; `moved` is the distance on the image if it was accepted.
  void count(Row& row, const StepResult& result, bool generated, double moved);
  void save(ByteWriter& bytes) const;
  void load(ByteReader& bytes);
};

/// Adds the rows that have any steps; `names` has their names and path lengths.
void add_rows(const std::vector<MutationStats>& names, const std::vector<ChainStats::Row>& rows,
              Stats& stats);

/// The error when there is nothing to start chains from.
RenderError no_light_found(uint64_t samples);

/// One Markov chain of a render.
class RenderChain {
 public:
  virtual ~RenderChain() = default;
  /// Advances this chain alone; see MetropolisAlgorithm::advance.
  virtual void advance(uint64_t steps, ChainRecorder& recorder) = 0;
  virtual const ChainStats& stats() const = 0;
  /// Sums over the samples that it starts from, if it draws them itself; else nullptr.
  virtual const SampleSums* samples() const { return nullptr; }
  /// The sum of L* that it has yet to record, in the mean, for what it has found.
  virtual double light_due() const { return 0; }
  virtual void save(ByteWriter& bytes) const = 0;
  virtual void load(ByteReader& bytes) = 0;
};

/// Identifies a chain by its group, and by its number in the group.
struct ChainId {
  uint64_t seed;
  int group, number, count;
  double b;  ///< Mean weight of the candidates that the chains of its group start from.
  Purpose purpose = Purpose::chain;

  Rng rng() const { return rng(purpose); }
  Rng rng(Purpose use) const { return Rng(seed, use, (uint64_t(group) << 32) | uint32_t(number)); }
};

/// What a kernel has if it does not say otherwise.
struct KernelDefaults {
  /// The weight with which the last proposal is recorded beside that of the step.
  double proposal_weight() const { return 0; }
  /// Counts what else it knows of its last step.
  void count_own(ChainStats::Row&) {}
};

/// A chain of any kernel, of KernelDefaults, that has State; stages; propose; generated(y);
/// record(recorder, x, weight) of a state with a target; raster_of(x); stats_row(), the row of the
/// statistics that its last step belongs to, of stats_rows(); rays(), traced so far; signature(x),
/// for messages; and save(bytes, x), load(bytes, x) for the state of the chain and its own.
template <class Kernel>
class RecordedChain : public RenderChain {
  using State = typename Kernel::State;

 public:
  RecordedChain(Kernel kernel, const ChainId& id, State start)
      : chain_(std::move(kernel), id.rng(), std::move(start)) {
    stats_.rows.resize(chain_.kernel().stats_rows());
  }

  void advance(uint64_t steps, ChainRecorder& recorder) override {
    StepRecorder<Kernel> record = begin(recorder);
    for (uint64_t i = 0; i < steps; ++i) step(record);
    record.finish();
  }

  // advance(), step by step:
  StepRecorder<Kernel> begin(ChainRecorder& recorder) {
    stats_.rays = chain_.kernel().rays();
    return {recorder, chain_.kernel(), chain_.state(), chain_.others()};
  }
  /// See Chain::prepare.
  template <class... Arguments>
  void prepare(size_t stage, Arguments&&... arguments) {
    chain_.prepare(stage, arguments...);
  }
  void step(StepRecorder<Kernel>& record) {
    Kernel& kernel = chain_.kernel();
    const Vec2 from = kernel.raster_of(chain_.state());
    const StepResult result = chain_.step(record);
    record.settle(result);
    const State& y = chain_.proposal(result, 0);
    ChainStats::Row& row = stats_.rows[kernel.stats_row()];
    stats_.count(row, result, kernel.generated(y),
                 glm::length(kernel.raster_of(chain_.state()) - from));
    row.rays += kernel.rays().total() - stats_.rays.total();
    stats_.rays = kernel.rays();
    kernel.count_own(row);
    if (stats_.run > stats_.longest.rejections && stats_.run % 64 == 0)
      stats_.longest = {stats_.run, kernel.raster_of(chain_.state()),
                        kernel.signature(chain_.state())};
  }

  /// Continues from another state; the statistics are kept.
  void restart(const State& start) {
    chain_.restart(start);
    stats_.run = 0;
  }
  const ChainStats& stats() const override { return stats_; }
  const State& state() const { return chain_.state(); }
  Kernel& kernel() { return chain_.kernel(); }
  const Kernel& kernel() const { return chain_.kernel(); }
  Rng& rng() { return chain_.rng(); }
  /// Counts a tour that is dead, or must wait after `steps` steps.
  void count_tour(uint64_t steps, bool dead) {
    stats_.tours += dead;
    stats_.longest_tour = std::max(stats_.longest_tour, steps);
  }
  /// Counts rays that were traced for it elsewhere.
  void count(const RayCounts& rays) {
    chain_.kernel().rays() += rays;
    stats_.rays = chain_.kernel().rays();
  }

  void save(ByteWriter& bytes) const override {
    chain_.kernel().save(bytes, chain_.state());
    save_progress(bytes);
  }
  void load(ByteReader& bytes) override {
    State x;
    chain_.kernel().load(bytes, x);
    chain_.restart(std::move(x));
    load_progress(bytes);
  }
  /// Saves all but the state, for a chain that is about to restart.
  void save_progress(ByteWriter& bytes) const {
    bytes.write(chain_.rng().state());
    stats_.save(bytes);
  }
  void load_progress(ByteReader& bytes) {
    chain_.rng() = Rng(bytes.read<Rng::State>());
    stats_.load(bytes);
    chain_.kernel().rays() = stats_.rays;
  }

 private:
  Chain<State, Kernel, Kernel::stages> chain_;
  ChainStats stats_;
};

}  // namespace mlt
