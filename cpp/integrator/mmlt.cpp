// mmlt: multiplexed Metropolis light transport. T. Hachisuka, A. Kaplanyan, C. Dachsbacher,
// "Multiplexed Metropolis light transport", SIGGRAPH 2014.
#include "integrator/multiplexed.h"

namespace mlt {

Plugin integrator_mmlt() {
  return make_plugin<MultiplexedIntegrator<TechniqueChange::keeps_numbers>>(integrator_schema(
      "mmlt",
      "Multiplexed Metropolis light transport (Hachisuka et al. 2014): mutates the random numbers "
      "of one path and the technique (s, t) that makes it. One spp is one mutation per pixel.",
      multiplexed_parameters(
          "Probability of a small step that also draws another technique for the same length.")));
}

}  // namespace mlt
