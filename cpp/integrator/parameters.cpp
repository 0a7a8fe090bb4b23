#include "integrator/parameters.h"

#include "base/error.h"

#include <limits>
#include <sstream>

namespace mlt {

// ---- paths --------------------------------------------------------------------------------------

std::vector<Parameter> path_parameters() {
  return {
      {"max_depth", ParamType::integer, int64_t{-1},
       "Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for "
       "4096, which is also the most."},
      {"rr_depth", ParamType::integer, int64_t{5},
       "Depth from which on Russian roulette may end a path."},
      {"hide_emitters", ParamType::boolean, false,
       "Leave out lights that the camera sees directly."},
      {"strict_normals", ParamType::boolean, false,
       "Refuse directions that the geometric and the shading normal see on different sides."},
      {"waves", ParamType::boolean, true,
       "Trace many paths side by side where that is possible (cpp/wave); else one by one, by the "
       "code that defines them (cpp/path). Both make the same image."},
  };
}

PathRules path_rules(Params& params) {
  constexpr int64_t most = std::numeric_limits<int>::max();
  PathRules rules;
  rules.max_depth = static_cast<int>(params.integer_in("max_depth", -1, most));
  if (rules.max_depth == 0)
    params.fail("max_depth", "is 0, but must be positive, or -1 for unbounded");
  rules.rr_depth = static_cast<int>(params.integer_in("rr_depth", 1, most));
  rules.hide_emitters = params.boolean("hide_emitters");
  rules.strict_normals = params.boolean("strict_normals");
  rules.waves = params.boolean("waves");
  return rules;
}

Parameter through_boundaries_parameter() {
  return {
      "through_boundaries", ParamType::boolean, true,
      "In media with rough boundaries that refract, such as wax and skin, light is also sampled "
      "through these. Samples are then taken one by one."};
}

// ---- layers of light ----------------------------------------------------------------------------

std::vector<Parameter> light_parameters() {
  return {
      {"light_groups", ParamType::boolean, false,
       "Keep the light of each lamp as a layer: `light.` with its id. They add up to the image, "
       "and each has a layer of its error, such as `error.light.lamp`."},
      {"exposure_layers", ParamType::boolean, false,
       "Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`, with "
       "a "
       "layer of its error. They add up to the image."},
      {"light_layers", ParamType::text, std::string(),
       "Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with "
       "regular expressions over the letters of a path from the light to the eye: L, S for each "
       "mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then taken "
       "one by one."}};
}

LightLayerSettings light_layers(Params& params) {
  LightLayerSettings settings;
  settings.groups = params.boolean("light_groups");
  settings.exposures = params.boolean("exposure_layers");
  std::istringstream given(params.text("light_layers"));
  for (std::string text; given >> text;) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos)
      params.fail("light_layers", "has '" + text + "', but should have NAME=EXPRESSION");
    settings.classes.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    try {
      class_expression(settings.classes.back().first, settings.classes.back().second);
    } catch (const UsageError& error) {
      params.fail("light_layers", std::string("is wrong: ") + error.what());
    }
  }
  return settings;
}

// ---- bidirectional path tracing -----------------------------------------------------------------

std::vector<Parameter> bidirectional_parameters() {
  return {
      {"light_image", ParamType::boolean, true,
       "Use techniques that connect light paths to the lens (t <= 1)."},
      {"sample_direct", ParamType::boolean, true,
       "Technique s = 1 chooses the light as seen from the point to be lit."},
      {"heuristic",
       ParamType::text,
       std::string("power"),
       "How techniques are combined (Veach 1997, sec. 9.2).",
       {"balance", "power", "maximum"}},
  };
}

BidirectionalSettings bidirectional_settings(Params& params) {
  BidirectionalSettings settings;
  settings.rules = path_rules(params);
  settings.light_image = params.boolean("light_image");
  settings.sample_direct = params.boolean("sample_direct");
  const std::string heuristic = params.text("heuristic");
  settings.heuristic = heuristic == "balance" ? Heuristic::balance
                       : heuristic == "power" ? Heuristic::power
                                              : Heuristic::maximum;
  return settings;
}

// ---- chains, tours and independent samples ------------------------------------------------------

std::vector<Parameter> chain_parameters(int64_t chains) {
  return {{"luminance_samples", ParamType::integer, int64_t{50000},
           "Paths drawn to start the chains from; as many are drawn before, to divide the time."},
          {"chains", ParamType::integer, chains,
           "Number of Markov chains, whatever the budget. The fewer there are, the longer each is, "
           "and the farther it gets from where it started; but one that stands still leaves a "
           "brighter spot, and no more threads than chains have work."}};
}

std::vector<Parameter> tour_parameters(int64_t chains) {
  return {{"luminance_samples", ParamType::integer, int64_t{50000},
           "Paths drawn before the render, from which the division of its time is found."},
          {"chains", ParamType::integer, chains,
           "Number of Markov chains, each of which starts over and over. It hardly matters, but no "
           "more threads than chains have work."}};
}

std::vector<Parameter> family_parameters() {
  return {
      {"independent_share", ParamType::real, no_default,
       "Share of the time for samples that are independent of the chains, 0 to 1. They show what "
       "they are good at, and tell the brightness b. By default the first samples tell the best "
       "one; 1: "
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

// ---- the mixture of mutations -------------------------------------------------------------------

namespace {

/// Reads the parameters of one mutation: its weight, or 0 if it is off, and its own parameters.
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

// ---- steps in primary sample space --------------------------------------------------------------

std::vector<Parameter> primary_step_parameters() {
  return {{"p_large", ParamType::real, 0.3,
           "Probability of a large step, which draws a new path independently."},
          {"small_step",
           ParamType::text,
           std::string("kelemen"),
           "How a small step moves a number: `kelemen` by 1/16 of the step size up to all of it, "
           "or `gaussian`.",
           {"kelemen", "gaussian"}},
          {"step_size", ParamType::real, no_default,
           "The largest move of a small step, by default 1/32, or the standard deviation of a "
           "Gaussian one, by default 0.01."},
          {"delayed_rejection", ParamType::boolean, false,
           "Let a small step follow a large one that was rejected."}};
}

SmallStep small_step(Params& params) {
  SmallStep step;
  if (params.text("small_step") == "gaussian") step = {SmallStep::Shape::gaussian, 0.01};
  if (params.has("step_size")) step.size = params.real_in("step_size", 1e-9, 0.5);
  return step;
}

double large_probability(Params& params) {
  const double probability = params.real_in("p_large", 0, 1);
  if (probability == 0)
    params.fail("p_large", "is 0, but without large steps a chain cannot reach the whole image");
  return probability;
}

}  // namespace mlt
