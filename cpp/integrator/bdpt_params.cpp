#include "integrator/bdpt_params.h"

#include "integrator/path_params.h"

namespace mlt {

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

std::vector<std::string> technique_names(int max_depth) {
  std::vector<std::string> names;
  for (int k = 1; k <= max_depth; ++k)
    for (int s = 0; s <= k + 1; ++s)
      names.push_back("s" + std::to_string(s) + ".t" + std::to_string(k + 1 - s));
  return names;
}

}  // namespace mlt
