// The lens perturbation (Veach & Guibas 1997, sec. 5.3.2.1; Veach 1997, sec. 11.3.3.1), for paths of the
// form (L|D)DS*E: the image position moves by a small distance (and, with a lens of finite aperture,
// half of the time the point on the lens too), the specular chain follows, and the diffuse vertex at
// its end is joined to the rest of the path.
//
// The multi-chain perturbation (Veach & Guibas 1997, sec. 5.3.2.3; Veach 1997, sec. 11.3.3.3) begins in
// the same way and goes on where the next vertex is specular again, (L|D)(DS+)*DS*E: there the direction is
// perturbed by a small angle, and so on, for any number of chains.
#pragma once

#include "mutation/chain_perturbation.h"

namespace mlt {

/// The two perturbations that start at the lens; they share all but the paths that they suit.
class CameraPerturbation : public Mutation {
 public:
  CameraPerturbation(const Scene& scene, const MutationSettings& settings)
      : scene_(&scene), settings_(settings), chain_(scene, settings) {}

  double suitability(const LightPath& x) const override;
  std::optional<Edit> propose(const LightPath& x, LightPath& y, MutationContext& context) const override;
  double density(const LightPath& x, const LightPath& y, const Edit& edit) const override;

 protected:
  /// How many chains follow the first.
  virtual bool suits(int further_chains) const = 0;

 private:
  struct Form {
    int stop = -1;  ///< The diffuse vertex that is joined to the rest; -1: the path has another form.
    int further_chains = 0;
  };
  Form form(const LightPath& x) const;
  ExponentialRadius lens_radius() const;

  const Scene* scene_;
  MutationSettings settings_;
  ChainPerturbation chain_;
};

class LensPerturbation : public CameraPerturbation {
 public:
  using CameraPerturbation::CameraPerturbation;
  const std::string& name() const override;

 protected:
  bool suits(int further_chains) const override { return further_chains == 0; }
};

class MultiChainPerturbation : public CameraPerturbation {
 public:
  using CameraPerturbation::CameraPerturbation;
  const std::string& name() const override;

 protected:
  bool suits(int further_chains) const override { return further_chains > 0; }
};

}  // namespace mlt
