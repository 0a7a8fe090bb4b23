// Parameters that several integrators share, and how they are read.
#pragma once

#include "base/params.h"
#include "integrator/tours/mlt_algorithm.h"
#include "path/bidirectional_sampler.h"
#include "primary/small_step.h"
#include "rendering/metropolis_rendering.h"

namespace mlt {

/// Parameters of all integrators over paths, with Mitsuba's names and defaults.
std::vector<Parameter> path_parameters();
PathRules path_rules(Params& params);
/// A parameter of those that render alone.
Parameter through_boundaries_parameter();

/// Parameters of integrators that keep layers of light.
std::vector<Parameter> light_parameters();
LightLayerSettings light_layers(Params& params);
/// The defaults of sampled integrators that keep them.
struct LayeredDefaults : SampledDefaults {
  static LightLayerSettings light_layers(Params& params) { return mlt::light_layers(params); }
};

/// Parameters of bidirectional path tracing.
std::vector<Parameter> bidirectional_parameters();
/// Reads the parameters of bidirectional path tracing and of paths.
BidirectionalSettings bidirectional_settings(Params& params);

/// Parameters of chains that start from a bootstrap.
std::vector<Parameter> chain_parameters(int64_t chains = 128);
/// Parameters of tours, which need no bootstrap.
std::vector<Parameter> tour_parameters(int64_t chains);
/// Parameters of the independent samples beside chains or tours.
std::vector<Parameter> family_parameters();
/// Reads the parameters of independent samples and of chains or tours.
MetropolisSettings metropolis_settings(Params& params);

/// Parameters that choose the mutations of light paths.
std::vector<Parameter> mixture_parameters(const std::vector<MutationPlugin>& plugins);
/// The mutations that are on, at least one.
std::vector<MixedMutation> read_mixture(Params& params, const std::vector<MutationPlugin>& plugins);

/// Parameters of steps in primary sample space.
std::vector<Parameter> primary_step_parameters();
SmallStep small_step(Params& params);
double large_probability(Params& params);

}  // namespace mlt
