// What the two perturbations that start at the lens share: the image position moves by a small distance
// (and, with a lens of finite aperture, half of the time the point on the lens too) and the path
// follows, up to the diffuse vertex that is joined to the rest. They differ in the paths that they suit:
// lens.h has the form (L|D)DS*E, multi_chain.h (L|D)(DS+)+DS*E.
//
// Where specular vertices lead on to the light, LS*E and L(S+D)+S*E, nothing can be joined; Veach leaves
// these paths to the bidirectional mutation. Here the whole path follows, and its end has to hit a light
// again: so a lamp is explored in a mirror, and what it lights through glass, seen through glass.
#pragma once

#include "mutation/chain_perturbation.h"

namespace mlt {

class CameraPerturbation : public Mutation {
 public:
  CameraPerturbation(const Scene& scene, const MutationSettings& settings)
      : scene_(&scene), settings_(settings), chain_(scene, settings) {}

  double suitability(const PathState& x) const override;
  std::optional<Edit> propose(const PathState& x, PathState& y,
                              MutationContext& context) const override;
  double density(const PathState& x, const PathState& y, const Edit& edit) const override;

 protected:
  /// How many chains follow the first.
  virtual bool suits(int further_chains) const = 0;

 private:
  struct Form {
    int stop =
        -1;  ///< The diffuse vertex that is joined to the rest; 0: a light that is hit; -1: neither.
    int further_chains = 0;
  };
  Form form(const PathState& x) const;
  ExponentialRadius lens_radius() const;

  const Scene* scene_;
  MutationSettings settings_;
  ChainPerturbation chain_;
};

}  // namespace mlt
