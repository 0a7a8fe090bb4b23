#include "integrator/metropolis_params.h"

namespace mlt {

std::vector<Parameter> chain_parameters(int64_t chains) {
  return {{"luminance_samples", ParamType::integer, int64_t{50000},
           "Paths drawn to start the chains from; a pilot before that draws about as many."},
          {"chains", ParamType::integer, chains,
           "Number of Markov chains, whatever the budget. The fewer there are, the longer each is, "
           "and the farther it gets from where it started; but one that stands still leaves a "
           "brighter spot, and no more threads than chains have work."}};
}

std::vector<Parameter> tour_parameters(int64_t chains) {
  return {{"luminance_samples", ParamType::integer, int64_t{50000},
           "The pilot before the render draws about as many paths."},
          {"chains", ParamType::integer, chains,
           "Number of Markov chains, each of which starts over and over. It hardly matters, but no "
           "more threads than chains have work."}};
}

std::vector<Parameter> family_parameters() {
  return {
      {"independent_share", ParamType::real, no_default,
       "Share of the time for samples that are independent of the chains, 0 to 1. They show what "
       "they are good at, and tell the brightness b. By default a pilot finds the best one; 1: "
       "there are no chains."},
      {"parts", ParamType::boolean, false,
       "Keep what chains and samples show of the image as layers `chains` and `samples`."},
  };
}

MetropolisSettings metropolis_settings(Params& params) {
  MetropolisSettings settings;
  settings.luminance_samples = params.integer_in("luminance_samples", 16, int64_t{1} << 40);
  settings.chains = static_cast<int>(params.integer_in("chains", 16, 1 << 24));
  if (params.has("independent_share"))
    settings.independent_share = params.real_in("independent_share", 0, 1);
  settings.parts = params.boolean("parts");
  return settings;
}

}  // namespace mlt
