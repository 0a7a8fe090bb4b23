// The lens subpath mutation (Veach 1997, sec. 11.3.4): the camera end of the path is replaced by a fresh
// one, for paths of the form ...(L|D)DS*E. A new point on the lens and a new image position are drawn, the
// walk goes on over surfaces that are (nearly) specular as their BSDF samples it, and the vertex where it
// stops is joined to the rest of the path.
//
// The image positions that the chains of one round use are stratified over the image; each by itself
// is uniform, so nothing else changes.
#pragma once

#include "mutation/mutation.h"

namespace mlt {

class LensSubpathMutation : public Mutation {
 public:
  explicit LensSubpathMutation(const PathTarget& target)
      : Mutation("lens_subpath"), target_(&target), scene_(&target.scene()) {}

  double suitability(const PathState& x) const override { return stop(x) > 0 ? 1 : 0; }
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override;
  double density(const PathState& x, const PathState& y, const Edit& edit) const override;

 private:
  /// The vertex that ends the lens subpath: the first from the camera at which a walk may stop; -1 if
  /// the one before it cannot be connected.
  int stop(const PathState& x) const;
  /// Probability with which a walk stops at this surface, to be joined there: 0 where all scattering is
  /// (nearly) specular, 1 where none is a delta.
  double stop_probability(const SurfacePoint& at) const;

  const PathTarget* target_;
  const Scene* scene_;
};

}  // namespace mlt
