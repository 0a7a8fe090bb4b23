#include "integrator/mixture_params.h"

namespace mlt {
namespace {

/// What the parameters say of one mutation: its weight, or 0 if it is off, and its own parameters.
MixedMutation read_mutation(const MutationPlugin& plugin, Params& params) {
  MixedMutation mixed{plugin.name(), 0};
  if (params.boolean(plugin.switch_name))
    mixed.weight = params.real_in(plugin.weight_name(), 0, 1e9);
  for (const Parameter& own : plugin.schema.parameters)
    if (const std::string name = plugin.full_name(own.name); params.has(name))
      mixed.values.push_back({own.name, params.value(name)});
  return mixed;
}

}  // namespace

std::vector<Parameter> mixture_parameters(const std::vector<MutationPlugin>& plugins) {
  std::vector<Parameter> parameters;
  for (const MutationPlugin& plugin : plugins) {
    parameters.push_back(
        {plugin.switch_name, ParamType::boolean, plugin.on, "Use the " + plugin.schema.doc});
    parameters.push_back(
        {plugin.weight_name(), ParamType::real, plugin.weight,
         "Weight of the " + plugin.name() + " mutation among those that suit a path."});
    for (Parameter own : plugin.schema.parameters) {
      own.name = plugin.full_name(own.name);
      parameters.push_back(own);
    }
  }
  return parameters;
}

std::vector<MixedMutation> read_mixture(Params& params,
                                        const std::vector<MutationPlugin>& plugins) {
  std::vector<MixedMutation> mixture;
  for (const MutationPlugin& plugin : plugins) {
    const MixedMutation mixed = read_mutation(plugin, params);
    if (mixed.weight > 0) mixture.push_back(mixed);
  }
  if (mixture.empty()) params.fail("needs at least one mutation with a positive weight");
  return mixture;
}

}  // namespace mlt
