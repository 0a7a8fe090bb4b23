// What single scattering by GGX microfacets keeps of the light, and factors that give back what it
// loses between them. Roughnesses are sqrt(alpha).
#pragma once

#include "scene/bsdf/energy_table.h"

#include <memory>

namespace mlt {

/// The light that a rough dielectric interface reflects from above.
struct InterfaceEnergy {
  EnergyTable reflectance;
  RoughnessTable mean;

  /// `eta` = n_below / n_above. Tables are made once for each index.
  static std::shared_ptr<const InterfaceEnergy> of(double eta);
};

/// Factors s, so that f(wl, wc) s(wl) s(wc) is as symmetric as f is, and loses no light where the
/// facets absorb none: the fixed point of s(w) int f(w, w') s(w') cos' dw' = 1 (Sinkhorn & Knopp
/// 1967, "Concerning nonnegative matrices and doubly stochastic matrices").
struct BalancedScales {
  EnergyTable above, below;

  /// For mirrors.
  static const BalancedScales& of_mirrors();
  /// For an interface that reflects and refracts, with light from both sides.
  static std::shared_ptr<const BalancedScales> of_glass(double eta);
};

}  // namespace mlt
