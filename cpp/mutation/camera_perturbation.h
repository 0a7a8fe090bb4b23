// What the two perturbations that start at the lens share: the image position moves by a small distance
// (and, with a lens of finite aperture, half of the time the point on the lens too) and the path
// follows, up to the diffuse vertex that is joined to the rest. They differ in the paths that they suit:
//
// The lens perturbation (Veach & Guibas 1997, sec. 5.3.2.1; Veach 1997, sec. 11.3.3.1) has the form
// (L|D)DS*E: it explores what is seen directly, in mirrors and through glass.
//
// The multi-chain perturbation (sec. 5.3.2.3; sec. 11.3.3.3) has the form (L|D)(DS+)+DS*E, such as a
// caustic seen through glass: where the path goes on from a diffuse vertex to another specular chain, the
// direction is perturbed by a small angle and carried through that chain, and so on, for any number of
// chains.
//
// Where specular vertices lead on to the light, LS*E and L(S+D)+S*E, nothing can be joined; Veach leaves
// these paths to the bidirectional mutation. Here the whole path follows, and its end has to hit a light
// again: so a lamp is explored in a mirror, and what it lights through glass, seen through glass.
#pragma once

#include "mutation/chain_perturbation.h"

namespace mlt {

class CameraPerturbation : public Mutation {
 public:
  enum class Chains { one, many };

  CameraPerturbation(std::string name, Chains chains, const PathTarget& target,
                     const StepSizes& steps)
      : Mutation(std::move(name)),
        chains_(chains),
        target_(&target),
        scene_(&target.scene()),
        chain_(target.scene(), steps) {}

  double suitability(const PathState& x) const override;
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override;
  double density(const PathState& x, const PathState& y, const Edit& edit) const override;

 private:
  struct Form {
    int stop =
        -1;  ///< The diffuse vertex that is joined to the rest; 0: a light that is hit; -1: neither.
    int further_chains = 0;
  };
  Form form(const PathState& x) const;
  ExponentialRadius lens_radius() const;

  Chains chains_;
  const PathTarget* target_;
  const Scene* scene_;
  ChainPerturbation chain_;
};

}  // namespace mlt
