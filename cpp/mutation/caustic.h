// The caustic perturbation (Veach & Guibas 1997, sec. 5.3.2.2; Veach 1997, sec. 11.3.3.2), for paths of the
// form (L|D)S*DE: the direction that leaves the light-side vertex turns by a small angle, the specular
// chain follows, and the diffuse vertex at its end is joined to the lens, at a new image position.
//
// Where the chain starts at a light at infinity its direction x_0 stays and the ray moves across the
// plane perpendicular to it. The angle (or the distance) is such that the image position moves about as
// far as the lens perturbation would move it.
#pragma once

#include "mutation/chain_perturbation.h"

namespace mlt {

class CausticPerturbation : public Mutation {
 public:
  CausticPerturbation(const PathTarget& target, const StepSizes& steps)
      : Mutation("caustic"),
        target_(&target),
        scene_(&target.scene()),
        chain_(target.scene(), steps) {}

  double suitability(const PathState& x) const override { return start(x) >= 0 ? 1 : 0; }
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override;
  double density(const PathState& x, const PathState& y, const Edit& edit) const override;

 private:
  /// The vertex from which the chain to the last diffuse vertex starts; -1: another form.
  int start(const PathState& x) const;
  ExponentialRadius offset_radius(const PathState& x) const;

  const PathTarget* target_;
  const Scene* scene_;
  ChainPerturbation chain_;
};

}  // namespace mlt
