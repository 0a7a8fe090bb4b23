#include "integrator/metropolis_params.h"

namespace mlt {

std::vector<Parameter> metropolis_parameters() {
  return {
      {"luminance_samples", ParamType::integer, int64_t{100000},
       "Paths drawn to estimate the image's mean brightness b and to start the chains from."},
      {"chains", ParamType::integer, int64_t{1024},
       "Number of Markov chains, whatever the budget: more samples make chains longer."},
  };
}

MetropolisSettings metropolis_settings(Params& params) {
  MetropolisSettings settings;
  settings.luminance_samples = params.integer_in("luminance_samples", 16, int64_t{1} << 40);
  settings.chains = static_cast<int>(params.integer_in("chains", 16, 1 << 24));
  return settings;
}

}  // namespace mlt
