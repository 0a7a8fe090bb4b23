// A specular chain that a mutation finds again by a manifold walk after vertex b, the end of it on
// the camera side, has moved: vertices c + 1 ... b - 1, with c the end that stays.
//
// The walk is a function of x and of the new b, but not always an invertible one: if the walk back
// from y does not lead to x, y is to be rejected.
#pragma once

#include "mutation/mutation.h"
#include "path/manifold_walk.h"
#include "path/measure.h"

namespace mlt {

struct ManifoldChain {
  int c, b;

  int count() const { return b - c - 1; }
  bool can_be_walked(const Scene& scene, const PathState& x) const;

  /// Finds the vertices of y between its ends, which it has already; false if the walk fails.
  bool find(const Scene& scene, const PathState& x, PathState& y, MutationContext& context) const;
  /// Whether the walk back from y leads to x.
  bool leads_back(const Scene& scene, const PathState& x, const PathState& y,
                  MutationContext& context) const;

  /// The factor of a density that is due to the chain, and to its edges, in y.
  template <class Measure>
  double density(const Measure& in, const Scene& scene, const PathState& y) const {
    return SpecularChain(scene, &y[c], count()).density() * edges(in);
  }

 private:
  /// Walks the chain of x to `end`, where b is now.
  bool follow(ManifoldWalk& walk, const Scene& scene, const PathState& x, const SurfacePoint& end,
              MutationContext& context) const;

  /// The factor, in a measure, of the density of vertices c ... b that are found by a walk and not
  /// sampled one by one.
  double edges(const AreaMeasure&) const { return 1; }
  double edges(const ContributionMeasure& in) const {
    double p = in.x[c].inverse_f;
    for (int i = c; i < b; ++i) p *= in.x[i + 1].inverse_f / in.x[i].G;
    return p;
  }
};

}  // namespace mlt
