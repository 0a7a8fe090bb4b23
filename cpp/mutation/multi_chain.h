// The multi-chain perturbation (Veach & Guibas 1997, sec. 5.3.2.3; Veach 1997, sec. 11.3.3.3), for paths of
// the forms (L|D)(DS+)+DS*E and L(S+D)+S*E, such as a caustic seen through glass: it begins like the lens
// perturbation, and where the path goes on from a diffuse vertex to another specular chain, the direction
// is perturbed by a small angle and carried through that chain, and so on, for any number of chains.
#pragma once

#include "mutation/camera_perturbation.h"

namespace mlt {

class MultiChainPerturbation : public CameraPerturbation {
 public:
  using CameraPerturbation::CameraPerturbation;
  const std::string& name() const override {
    static const std::string name = "multi_chain";
    return name;
  }

 protected:
  bool suits(int further_chains) const override { return further_chains > 0; }
};

}  // namespace mlt
