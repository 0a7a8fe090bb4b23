// The common part of mmlt and rjmlt, which differ in what a change of technique keeps.
#pragma once

#include "base/registry.h"
#include "integrator/multiplexed_algorithm.h"
#include "integrator/parameters.h"

namespace mlt {

template <TechniqueChange change>
class MultiplexedIntegrator : public Integrator {
 public:
  explicit MultiplexedIntegrator(Params& params)
      : metropolis_(metropolis_settings(params)),
        settings_{path_rules(params),
                  small_step(params),
                  {large_probability(params), params.real_in("p_technique", 0, 1), change,
                   params.boolean("delayed_rejection")}} {
    metropolis_.light = light_layers(params);
    if (settings_.moves.large_probability + settings_.moves.technique_probability > 1)
      params.fail("p_technique", "and 'p_large' are more than 1 together");
  }
  std::unique_ptr<Rendering> start(ScenePtr scene, uint64_t seed) const override {
    return std::make_unique<MetropolisRendering>(scene, seed, metropolis_,
                                                 multiplexed_algorithm(scene, settings_));
  }

 private:
  MetropolisSettings metropolis_;
  MultiplexedSettings settings_;
};

/// `p_technique`: the documentation of the parameter of that name.
inline std::vector<std::vector<Parameter>> multiplexed_parameters(const char* p_technique) {
  return {path_parameters(),         light_parameters(),
          chain_parameters(),        family_parameters(),
          primary_step_parameters(), {{"p_technique", ParamType::real, 0.1, p_technique}}};
}

}  // namespace mlt
