// The interface that distinguishes one Metropolis integrator from another.
#pragma once

#include "mutation/path_target.h"
#include "path/found_light.h"
#include "path/samplers.h"
#include "rendering/allocation.h"
#include "rendering/metropolis_chain.h"
#include "rendering/sampled_rendering.h"
#include "rendering/starting_paths.h"
#include "rendering/stats.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace mlt {

struct CoarseImage;

/// A chain that is to advance, and the recorder of its states.
struct ChainVisit {
  RenderChain* chain;
  ChainRecorder* recorder;
};

class MetropolisAlgorithm {
 public:
  virtual ~MetropolisAlgorithm() = default;

  /// Draws independent samples; reuses its buffers from one to the next.
  class Source {
   public:
    virtual ~Source() = default;
    /// The paths that a sample at a raster position finds; valid until the next one. If random
    /// numbers have given the position too, the sample may become the start of a chain.
    virtual const std::vector<FoundLight>& sample(const Vec2& raster, PixelSampler& sampler) = 0;
    virtual const std::vector<FoundLight>& sample(const Vec2& raster, RandomSampler& sampler) = 0;
    virtual const RayCounts& rays() const = 0;
    /// Cost per ray, everything included, relative to that of a chain.
    virtual double cost_of_ray() const { return 1; }
  };
  /// The source of the candidates from which chains start.
  virtual std::unique_ptr<Source> source() const = 0;
  /// Chooses whether samples of all techniques, or of path tracing alone, go to the image beside
  /// the chains; false if the algorithm has no samples of these techniques.
  virtual bool set_techniques(SampleTechniques techniques) {
    return techniques == SampleTechniques::all;
  }
  /// Called first, with the layers whose masks states are to have where they know no paths, or
  /// nullptr.
  virtual void keep_layers(const LightLayers* /*layers*/) {}
  /// The name of the chosen samples, where there is a choice.
  virtual std::string samples_name() const { return ""; }
  /// The source of the samples that go to the image, for the pilot.
  virtual std::unique_ptr<Source> sample_source() const { return source(); }
  /// Takes the samples that go to the image, for the render.
  virtual std::unique_ptr<SampleTaker> sample_taker(const ClampingWeights& weights) const = 0;
  virtual const Scene& scene() const = 0;
  /// Starts a chain from the candidate that the same stream gave; `choice` chooses one of the
  /// paths that the candidate consists of.
  virtual std::unique_ptr<RenderChain> start(const ChainId& /*id*/, Rng /*candidate*/,
                                             Rng /*choice*/) const {
    return nullptr;
  }
  /// Whether chains draw their own starting samples (PathTours), and so begin blank.
  virtual bool has_tours() const { return false; }
  /// Draws samples that tours start from, for the pilot.
  virtual std::unique_ptr<StartingPaths> starting_paths() const { return nullptr; }
  /// Cost of a mutation in rays of chains, where a sample has so many; everything else costs about
  /// as much as one ray more.
  virtual double cost_of_mutation(double /*rays_of_sample*/) const {
    constexpr double rays = 3;  // in the mean of all scenes
    return 1 + rays;
  }
  /// A chain without a state, to be loaded from bytes.
  virtual std::unique_ptr<RenderChain> blank(const ChainId& id,
                                             const Allocation& allocation) const = 0;
  /// The number of chains of a group that advance together.
  virtual int chains_together() const { return 1; }
  /// Advances chains together; each takes the steps that it would take alone, up to rounding.
  virtual void advance(const std::vector<ChainVisit>& chains, uint64_t steps) const {
    for (const ChainVisit& visit : chains) visit.chain->advance(steps, *visit.recorder);
  }
  /// Name and path length of each row of the statistics.
  virtual std::vector<MutationStats> rows() const = 0;
  /// Called once before the first sample; `seconds` are those of the pilot.
  virtual void learn(double /*seconds*/) {}
  /// Called once before the first sample that is weighed. `share`: that of a pilot's usual work.
  virtual void look_around(double /*share*/, uint64_t /*seed*/, int /*threads*/,
                           const std::atomic<bool>& /*cancelled*/) {}
  /// Called once before the time is divided, with a coarse image that may become a part of the
  /// target.
  virtual void prepare(const CoarseImage& /*coarse*/, uint64_t /*seed*/, int /*threads*/,
                       const std::atomic<bool>& /*cancelled*/) {}
  /// Called once when the time is divided, before the first chain.
  virtual void set_weights(const ClampingWeights& /*weights*/) {}
  /// Called once after that, to learn from pilot chains.
  virtual void adapt(double /*share*/, uint64_t /*seed*/, int /*threads*/,
                     const std::atomic<bool>& /*cancelled*/) {}
  /// Called once after the pilot.
  virtual void end_pilot() {}
  virtual std::string save() const { return ""; }
  virtual void load(const std::string& /*bytes*/) {}
};

/// The weights of a sample of the whole image, summed over its paths.
struct SampleWeights {
  double target = 0;      ///< T / p.
  double brightness = 0;  ///< L* / p.
  double of_chains = 0;   ///< w2 L* / p.

  void add(const FoundLight& found, const ClampingWeights& weights) {
    const double luminance = target_luminance(found.rgb);
    target += found.weight;
    brightness += luminance;
    of_chains += luminance * weights.of_chain(found.target_over_density);
  }
};

template <class Sampler>
SampleWeights weigh(MetropolisAlgorithm::Source& source, const Raster& raster, Sampler sampler,
                    const ClampingWeights& weights = {}) {
  SampleWeights sum;
  const Vec2 position = raster.sample(sampler.next2());
  for (const FoundLight& found : source.sample(position, sampler))
    if (found.valid()) sum.add(found, weights);
  return sum;
}

}  // namespace mlt
