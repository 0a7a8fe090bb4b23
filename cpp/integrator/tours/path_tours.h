// Tours of light paths (markov/tour.h) from the samples of bidirectional path tracing.
#pragma once

#include "integrator/tours/path_kernel.h"
#include "integrator/tours/steps_in_pixels.h"
#include "markov/tour.h"
#include "mutation/path_seeds.h"
#include "rendering/metropolis_algorithm.h"

#include <limits>
#include <vector>

namespace mlt {

/// How a render's tours are started and ended.
struct TourRules {
  KillRate rate;
  double steps_per_start;  ///< Expected work for a sample that tours start from, in steps.
  /// The most steps of a tour from a pixel for each sample of that (see steps_in_pixels.h).
  double steps_in_pixel = std::numeric_limits<double>::infinity();
};

/// A chain of tours. Each advance draws as many samples as should be `steps` of work, and ends with
/// the last tour that need not wait. The target must outlive it.
///
/// The samples are drawn side by side where a wave supports the scene. It does not make paths: a
/// sample whose light starts a tour is drawn again.
class PathTours : public RenderChain {
 public:
  PathTours(const PathTarget& target, const PathMixture& mixture, const ChainId& id,
            const TourRules& rules);

  void advance(uint64_t steps, ChainRecorder& recorder) override;
  const ChainStats& stats() const override { return chain_.stats(); }
  const SampleSums* samples() const override { return &samples_; }
  double light_due() const override;
  void save(ByteWriter& bytes) const override;
  void load(ByteReader& bytes) override;

 private:
  struct Waiting {
    PathState state;
    Tour tour;
    StepsInPixels steps;
  };
  /// What decides which tours start from a sample: numbers that are spread evenly over all samples
  /// of a group, since few tours are long.
  struct Chances {
    double kill;    ///< u of its first tour.
    double copies;  ///< Rounds the number of tours from a path, up if it is large.

    Chances of(int joint) const;
  };

  void draw_side_by_side(uint64_t samples, ChainRecorder& recorder);
  void draw(uint64_t sample, ChainRecorder& recorder);
  void start_tours(uint64_t sample, ChainRecorder& recorder, SampleWeights* sum);
  void add(const SampleWeights& sum);
  double bound(double over_starts) const;
  Chances chances(uint64_t sample) const;
  template <class Start>
  void choose(const Chances& chances, double over_starts, double paths, Start&& start) const;
  void start_tour(double u, ChainRecorder& recorder);
  void continue_tours(ChainRecorder& recorder);
  bool go_on(const PathState& start, Tour& tour, ChainRecorder& recorder);
  double survival(const PathState& x) const {
    return rules_.rate.survival(target_->over_starts(x));
  }
  double most_in_pixel() const;
  /// The chains of a group share its sequences, so that these are stratified over the group.
  uint64_t in_group(uint64_t i) const { return i * id_.count + id_.number; }

  const PathTarget* target_;
  TourRules rules_;
  PathSeeds seeds_;
  bool in_waves_;
  RecordedChain<PathKernel> chain_;
  PathState start_;
  StepsInPixels steps_;  ///< Steps of the current tour.
  SampleSums samples_;
  ChainId id_;
  uint64_t stream_;  ///< Random stream of the group.
  std::vector<Waiting> waiting_;
  uint64_t count_ = 0;  ///< Samples so far.
  double due_;          ///< Fraction of the next sample that is due.
  Chances first_chances_;
};

}  // namespace mlt
