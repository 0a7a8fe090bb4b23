// The lens perturbation (Veach & Guibas 1997, sec. 5.3.2.1; Veach 1997, sec. 11.3.3.1), for paths of the
// forms (L|D)DS*E and LS*E: the image position moves by a small distance, the specular chain follows, and
// the diffuse vertex at its end is joined to the rest of the path, or the light is hit again. It explores
// what is seen directly, in mirrors and through glass.
#pragma once

#include "mutation/camera_perturbation.h"

namespace mlt {

class LensPerturbation : public CameraPerturbation {
 public:
  using CameraPerturbation::CameraPerturbation;
  const std::string& name() const override {
    static const std::string name = "lens";
    return name;
  }

 protected:
  bool suits(int further_chains) const override { return further_chains == 0; }
};

}  // namespace mlt
