#include "integrator/small_step_params.h"

namespace mlt {

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
