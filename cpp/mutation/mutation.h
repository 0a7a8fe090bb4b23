// The contract of a mutation of light paths (Veach 1997, sec. 11.2-11.3).
//
// A mutation proposes y from x with density q(x -> y) in the product-area measure of the vertices
// that it inserts. It is right if it leaves L* invariant, whatever it is mixed with; the audit
// tests just that.
#pragma once

#include "base/rng.h"
#include "markov/step.h"
#include "mutation/path_target.h"
#include "path/bidirectional_sampler.h"
#include "path/ray_counts.h"
#include "primary/primary_samples.h"

#include <limits>
#include <optional>
#include <string>

namespace mlt {

/// Paths made of primary samples, and the samples; both reuse their buffers.
struct PrimaryWalks {
  PrimarySamples numbers, moved;
  BidirectionalSampler paths;
};

/// Numbers of proposals given up since a manifold walk failed: the one forth, or the one back.
struct WalkFailures {
  uint64_t there = 0, back = 0;
};

/// Data of a chain that its mutations share, beside random numbers.
struct MutationScratch {
  RayCounts rays;                             ///< Rays that its mutations have traced so far.
  WalkFailures failures;                      ///< Failures since the counts were last taken.
  std::optional<PrimaryWalks> primary_walks;  ///< Made at their first use.
};

/// The random numbers and the data of the chain that a proposal may use.
struct MutationContext {
  MutationContext(Rng& rng, MutationScratch& scratch)
      : rng(rng), rays(scratch.rays), failures(scratch.failures), scratch_(&scratch) {}

  /// A uniform raster position.
  Vec2 raster_position(const Raster& raster) const {
    const double x = rng.next();
    return raster.sample({x, rng.next()});
  }

  /// Walks in primary sample space, without Russian roulette.
  PrimaryWalks& primary_walks(const Scene& scene, const PathRules& rules) {
    if (!scratch_->primary_walks) {
      BidirectionalSettings settings;
      settings.rules = rules;
      settings.rules.rr_depth = PathRules::no_roulette;
      settings.rules.through_boundaries = false;  // not among the techniques of these numbers
      scratch_->primary_walks = {{}, {}, {scene, settings}};
    }
    return *scratch_->primary_walks;
  }

  Rng& rng;
  RayCounts& rays;
  WalkFailures& failures;

 private:
  MutationScratch* scratch_;
};

class Mutation {
 public:
  using State = PathState;
  using Scratch = MutationScratch;
  using Context = MutationContext;
  using Edit = mlt::Edit;

  /// The target must outlive it.
  Mutation(std::string name, const PathTarget& target) : name_(std::move(name)), target_(&target) {}
  virtual ~Mutation() = default;
  const std::string& name() const { return name_; }
  const PathTarget& target() const { return *target_; }

  /// Whether it can act on this path: the factor of its weight in the choice of mutations, 0 or 1.
  virtual double suitability(const PathState& x) const = 0;

  /// Makes y from x, with its terms evaluated; nullopt if nothing was found. The connecting edge
  /// has been tested for visibility if y.target > 0.
  virtual std::optional<Edit> propose(const PathState& x, PathState& y,
                                      MutationContext& context) const = 0;

  /// q(x -> y) for this edit, without the probability of having chosen this mutation. The reverse
  /// is density(y, x, edit.reversed()).
  virtual double density(const PathState& x, const PathState& y, const Edit& edit) const = 0;

  /// q(x -> y) / |f|, where |f| is that of the part of y that the edit changes: its edges, its
  /// vertices and their neighbours. By default the quotient of the two; MeasuredMutation cancels
  /// their common factors.
  virtual double relative_density(const PathState& x, const PathState& y, const Edit& edit) const;

  /// q(x -> y) / L*(y) and q(y -> x) / L*(x), up to |f| of the part that the edit does not change.
  Transition quotients(const PathState& x, const PathState& y, const Edit& edit) const {
    const double forward = relative_density(x, y, edit) / y.target;
    // by rounding, a chain may start from a path without light, which it leaves at once
    if (x.target == 0) return {forward, std::numeric_limits<double>::max()};
    return {forward, relative_density(y, x, edit.reversed()) / x.target};
  }

  /// Whether it alone can turn any path into any other.
  virtual bool ergodic() const { return false; }

  /// The row of the weights of mutations for x: they depend on path length.
  static size_t row(const PathState& x) { return static_cast<size_t>(x.edges()); }
  static MoveChoice* cached_choice(const PathState& x) { return &x.choice; }

 protected:
  const Scene& scene() const { return target_->scene(); }

 private:
  std::string name_;
  const PathTarget* target_;
};

}  // namespace mlt
