#include "integrator/path_params.h"

#include <limits>

namespace mlt {

std::vector<Parameter> path_parameters() {
  return {
      {"max_depth", ParamType::integer, int64_t{-1},
       "Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 is "
       "unbounded."},
      {"rr_depth", ParamType::integer, int64_t{5},
       "Depth from which on Russian roulette may end a path."},
      {"hide_emitters", ParamType::boolean, false,
       "Leave out lights that the camera sees directly."},
      {"strict_normals", ParamType::boolean, false,
       "Refuse directions that the geometric and the shading normal see on different sides."},
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
  return rules;
}

}  // namespace mlt
