// What distinguishes one Metropolis integrator from another.
#pragma once

#include "mutation/path_target.h"
#include "path/samplers.h"
#include "rendering/metropolis_chain.h"
#include "rendering/sampled_rendering.h"
#include "rendering/stats.h"

#include <atomic>
#include <memory>
#include <string>
#include <vector>

namespace mlt {

/// A path that an independent sample has found.
struct FoundLight {
  Vec2 raster;
  Color rgb;                   ///< What it adds to the image: f / p, weighted among techniques.
  double weight;               ///< What it adds to b, the integral of the target: T / p.
  double target_over_density;  ///< T / P, see FamilyWeights.
  bool own_pixel;              ///< At the sample's own image position, not by light tracing.

  bool valid() const {
    return is_finite(rgb) && min_component(rgb) >= 0 && weight >= 0 && std::isfinite(weight) &&
           target_over_density >= 0;
  }
};

/// What independent samples tell before a render.
struct CoarseImage {
  TargetMap map;  ///< The image as cells.
  double b = 0;   ///< Mean of the weights T / p.
};

class MetropolisAlgorithm {
 public:
  virtual ~MetropolisAlgorithm() = default;

  /// Draws independent samples, and keeps its memory from one to the next.
  class Source {
   public:
    virtual ~Source() = default;
    /// What a sample at a raster position finds; valid until the next one. If random numbers have
    /// given the position as well, the sample may become the start of a chain.
    virtual const std::vector<FoundLight>& sample(const Vec2& raster, PixelSampler& sampler) = 0;
    virtual const std::vector<FoundLight>& sample(const Vec2& raster, RandomSampler& sampler) = 0;
    virtual const RayCounts& rays() const = 0;
    /// What a ray costs in all, over what a ray of a chain costs.
    virtual double cost_of_ray() const { return 1; }
  };
  /// Of candidates from which chains start.
  virtual std::unique_ptr<Source> source() const = 0;
  /// Whether those samples, or the ones of path tracing, go to the image beside the chains; false
  /// if there are none of these techniques.
  virtual bool set_techniques(SampleTechniques techniques) {
    return techniques == SampleTechniques::all;
  }
  /// What the chosen samples are called, where there is a choice.
  virtual std::string samples_name() const { return ""; }
  /// Of what goes to the image, for the pilot,
  virtual std::unique_ptr<Source> sample_source() const { return source(); }
  /// and for the render.
  virtual std::unique_ptr<SampleTaker> sample_taker(const FamilyWeights& weights) const;
  virtual const Scene& scene() const = 0;
  /// Starts a chain from the candidate that the same stream gave; `choice` is there to choose one
  /// of several paths that the candidate consists of.
  virtual std::unique_ptr<RenderChain> start(const ChainId& id, Rng candidate,
                                             Rng choice) const = 0;
  /// Whether a blank chain may begin, since it finds its starts itself (PathTours).
  virtual bool has_tours() const { return false; }
  /// A chain without a state, to be loaded from bytes. Tours make so many steps in the mean from
  /// each sample, if id.b is b, and tell what the samples weigh.
  virtual std::unique_ptr<RenderChain> blank(const ChainId& id, const FamilyWeights& weights,
                                             double steps_per_sample) const = 0;
  /// So many chains of a group advance together,
  virtual int chains_together() const { return 1; }
  /// which is done here; each chain goes where it would go alone, up to rounding.
  virtual void advance(const std::vector<ChainVisit>& chains, uint64_t steps) const {
    for (const ChainVisit& visit : chains) visit.chain->advance(steps, *visit.recorder);
  }
  /// Name and path length of each row of the statistics.
  virtual std::vector<MutationStats> rows() const = 0;
  /// Called once before the first sample.
  virtual void look_around(uint64_t /*seed*/, int /*threads*/,
                           const std::atomic<bool>& /*cancelled*/) {}
  /// Called once before the first chain, to prepare whatever is to be known by then, with a coarse
  /// image that may become a part of the target.
  virtual void prepare(const CoarseImage& /*coarse*/, uint64_t /*seed*/, int /*threads*/,
                       const std::atomic<bool>& /*cancelled*/) {}
  virtual std::string save() const { return ""; }
  virtual void load(const std::string& /*bytes*/) {}
};

/// What a sample of the whole image weighs, over all its paths.
struct SampleWeights {
  double target = 0;      ///< T / p.
  double brightness = 0;  ///< L* / p.
  double of_chains = 0;   ///< w2 L* / p.

  void add(const FoundLight& found, const FamilyWeights& weights) {
    const double luminance = target_luminance(found.rgb);
    target += found.weight;
    brightness += luminance;
    of_chains += luminance * weights.of_chain(found.target_over_density);
  }
};

template <class Sampler>
SampleWeights weigh(MetropolisAlgorithm::Source& source, const Raster& raster, Sampler sampler,
                    const FamilyWeights& weights = {}) {
  SampleWeights sum;
  const Vec2 position = raster.sample(sampler.next2());
  for (const FoundLight& found : source.sample(position, sampler))
    if (found.valid()) sum.add(found, weights);
  return sum;
}

}  // namespace mlt
