// rjmlt: mmlt with changes of technique that keep the path. B. Bitterli, W. Jakob, J. Novak,
// W. Jarosz, "Reversible jump Metropolis light transport using inverse mappings", TOG 2018.
#include "integrator/multiplexed.h"

namespace mlt {

Plugin integrator_rjmlt() {
  return make_plugin<MultiplexedIntegrator<TechniqueChange::keeps_path>>(integrator_schema(
      "rjmlt",
      "Reversible jump Metropolis light transport (Bitterli et al. 2018): as mmlt, but a step that "
      "changes the technique keeps the path. One spp is one mutation per pixel.",
      multiplexed_parameters("Probability of a step that changes the technique, not the path.")));
}

}  // namespace mlt
