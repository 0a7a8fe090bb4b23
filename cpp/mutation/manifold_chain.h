// A specular chain that a mutation finds again by a manifold walk after vertex b, the end of it on
// the camera side, has moved, or the wavelength has: vertices c + 1 ... b - 1, where c is the end
// that stays.
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

  /// The determinant of the derivative of the constraints by the vertices.
  double jacobian(const Scene& scene, const PathState& y) const {
    return SpecularChain(scene, &y[c], count()).density();
  }
  /// The factor of a density that is due to the chain, and to its edges, in y.
  template <class Measure>
  double density(const Measure& in, const Scene& scene, const PathState& y) const {
    return jacobian(scene, y) * unsampled(in, c, b);
  }

 private:
  /// Walks the chain of x to `end`, where b is now, perhaps at another wavelength.
  bool follow(ManifoldWalk& walk, const Scene& scene, const PathState& x, const SurfacePoint& end,
              MutationContext& context) const;
};

}  // namespace mlt
