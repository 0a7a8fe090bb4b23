// Tours of light paths (markov/tour.h) from the samples of bidirectional path tracing.
#pragma once

#include "markov/tour.h"
#include "mutation/path_seeds.h"
#include "rendering/metropolis_algorithm.h"
#include "rendering/path_kernel.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace mlt {

/// A chain of tours. Each advance draws as many samples as have `steps` steps in the mean, and ends
/// with the last tour. A tour from a path that is found too rarely would take most of a short
/// render, and fill its image with the light of one sample. Such a tour waits when it has made as
/// many steps as all tours of the chain make in the mean, times `patience`, and goes on as that
/// grows. What it has yet to do is missing in the image: in the long run, nothing.
class PathTours : public RenderChain {
 public:
  /// `rate` has kappa0 = id.b / steps_per_sample.
  PathTours(const PathTarget& target, const PathMixture& mixture, const ChainId& id,
            const FamilyWeights& weights, double steps_per_sample, const KillRate& rate,
            double patience = std::numeric_limits<double>::infinity())
      : target_(&target),
        weights_(weights),
        kill_rate_(rate),
        steps_per_sample_(steps_per_sample),
        patience_(patience),
        seeds_(target),
        chain_(PathKernel(target, mixture), id, {}),
        id_(id),
        stream_(mix_bits(mix_bits(id.seed ^ mix_bits(uint64_t(id.purpose))) + id.group)),
        due_(chain_.rng().next()),
        first_kill_(Rng(stream_, id.purpose, 0).next()) {}

  void advance(uint64_t steps, ChainRecorder& recorder) override {
    due_ += static_cast<double>(steps) / steps_per_sample_;
    for (; due_ >= 1; --due_) start_tours(recorder);
    continue_tours(recorder);
  }
  const ChainStats& stats() const override { return chain_.stats(); }
  const SampleSums* samples() const override { return &samples_; }
  double steps_due() const override {
    double sum = 0;
    for (const Waiting& waiting : waiting_) sum += kill_rate_.steps(over_density(waiting.state));
    return sum;
  }

  void save(ByteWriter& bytes) const override {
    chain_.save_progress(bytes);
    samples_.save(bytes);
    bytes.write(count_);
    bytes.write(tours_);
    bytes.write(due_);
    bytes.write<uint64_t>(waiting_.size());
    for (const Waiting& waiting : waiting_) {
      bytes.write(waiting.tour);
      chain_.kernel().save(bytes, waiting.state);
    }
  }
  void load(ByteReader& bytes) override {
    chain_.load_progress(bytes);
    samples_.load(bytes);
    bytes.read(count_);
    bytes.read(tours_);
    bytes.read(due_);
    if (!(0 <= due_ && due_ < 1)) throw RenderError("the saved state owes more than a sample");
    waiting_.clear();
    for (auto left = bytes.read<uint64_t>(); left > 0; --left) {
      Waiting& waiting = waiting_.emplace_back();
      bytes.read(waiting.tour);
      chain_.kernel().load(bytes, waiting.state);
    }
  }

 private:
  /// A path that roulette has let through with probability q starts r / q tours in the mean, times
  /// found_again where the probability of finding it is estimated.
  void start_tours(ChainRecorder& recorder) {
    SampleWeights sum;
    PixelSampler sampler(stream_, static_cast<uint32_t>(in_group(count_++)));
    const Vec2 raster = target_->scene().camera().raster().sample(sampler.next2());
    seeds_.draw(raster, sampler, [&](const Connection& c, double weight) {
      const double over_density = weight / c.weight * c.own_share;
      const double luminance = target_luminance(c.contribution) * c.weight;
      sum.brightness += luminance;
      sum.of_chains += luminance * weights_.of_chain(over_density);
      if (!std::isfinite(over_density)) return;
      const double starts = kill_rate_.starts(over_density) / c.survival * c.found_again;
      bool assembled = false;
      for (double n = std::floor(starts + chain_.rng().next()); n > 0; --n) {
        const double u = next_kill();
        if (!(kill_rate_.survival(over_density) > u)) continue;
        if (!assembled) seeds_.assemble(c, start_);
        assembled = true;
        if (start_.target > 0) start_tour(u, recorder);
      }
    });
    add(sum);
    chain_.count(seeds_.take_rays());
  }

  /// The weights of a sample are those of all techniques.
  void add(const SampleWeights& sum) {
    samples_.brightness.add(sum.brightness);
    samples_.classes.add(sum.brightness);
    if (target_->techniques() == SampleTechniques::all) samples_.of_chains.add(sum.of_chains);
  }

  struct Waiting {
    PathState state;
    Tour tour;
  };

  void start_tour(double u, ChainRecorder& recorder) {
    Tour tour{u};
    if (!go_on(start_, tour, recorder)) waiting_.push_back({chain_.state(), tour});
  }
  void continue_tours(ChainRecorder& recorder) {
    const auto dead = [&](Waiting& waiting) {
      if (go_on(waiting.state, waiting.tour, recorder)) return true;
      waiting.state = chain_.state();
      return false;
    };
    waiting_.erase(std::remove_if(waiting_.begin(), waiting_.end(), dead), waiting_.end());
  }
  /// Goes on with a tour until it dies or must wait. Returns whether it is dead.
  bool go_on(const PathState& start, Tour& tour, ChainRecorder& recorder) {
    chain_.restart(start);
    StepRecorder<PathKernel> record = chain_.begin(recorder);
    const PathState& x = chain_.state();
    const bool dead =
        run_tour(tour, most_steps(), [&] { return survival(x); }, [&] { chain_.step(record); });
    record.finish();
    chain_.count_tour(tour.steps, dead);
    return dead;
  }
  double survival(const PathState& x) const { return kill_rate_.survival(over_density(x)); }
  double over_density(const PathState& x) const { return target_->over_bidirectional_density(x); }
  double most_steps() const { return patience_ * steps_per_sample_ * static_cast<double>(count_); }

  /// The chains of a group share its sequences, so that these are stratified over the group.
  uint64_t in_group(uint64_t i) const { return i * id_.count + id_.number; }
  /// Spread evenly over all tours (Kronecker sequence of the golden ratio), since few of them are
  /// long.
  double next_kill() {
    const double turns = first_kill_ + static_cast<double>(in_group(tours_++)) * 0.6180339887498949;
    return turns - std::floor(turns);
  }

  const PathTarget* target_;
  FamilyWeights weights_;
  KillRate kill_rate_;
  double steps_per_sample_, patience_;
  PathSeeds seeds_;
  RecordedChain<PathKernel> chain_;
  PathState start_;
  SampleSums samples_;
  ChainId id_;
  uint64_t stream_;  ///< Random stream of the group.
  std::vector<Waiting> waiting_;
  uint64_t count_ = 0, tours_ = 0;
  double due_;  ///< Fraction of the next sample that is due.
  double first_kill_;
};

}  // namespace mlt
