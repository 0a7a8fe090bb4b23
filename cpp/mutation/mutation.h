// The contract of a mutation of light paths (Veach 1997, sec. 11.2-11.3).
//
// A mutation proposes y from x with density T(x -> y) in the product-area measure of what it inserts.
// It is right if it leaves L* unchanged, whatever else is mixed with it; the audit tests just that.
#pragma once

#include "base/rng.h"
#include "mutation/path_state.h"
#include "mutation/stratified_raster.h"
#include "path/ray_counts.h"

#include <optional>
#include <string>

namespace mlt {

/// What a proposal may draw on.
struct MutationContext {
  Rng& rng;
  RayCounts& rays;
  StratifiedRaster stratified_raster{};
};

class Mutation {
 public:
  virtual ~Mutation() = default;
  virtual const std::string& name() const = 0;

  /// Can it act on this path? Weight with which it takes part in the choice, 0 or 1.
  virtual double suitability(const PathState& x) const = 0;

  /// Makes y from x, with its terms evaluated; nullopt if nothing was found. The connecting edge has
  /// been tested for visibility if y.target > 0.
  virtual std::optional<Edit> propose(const PathState& x, PathState& y,
                                      MutationContext& context) const = 0;

  /// T(x -> y) for this edit, without the probability of having chosen this mutation. The reverse is
  /// density(y, x, edit.reversed()).
  virtual double density(const PathState& x, const PathState& y, const Edit& edit) const = 0;
};

}  // namespace mlt
