#include "primary/multiplexed_step.h"

#include "primary/invert_path.h"

namespace mlt {
namespace {

/// Tolerances of inversion followed by a walk: rounding errors grow along a path.
constexpr double rounding = 0.01, rounding_in_pixels = 0.05;

/// Whether f / P is the same in both states, as it is whichever technique makes the path.
bool same_path(const MultiplexedState& x, const MultiplexedState& y) {
  return glm::length(y.raster - x.raster) < rounding_in_pixels &&
         std::abs(y.target_over_density - x.target_over_density) < rounding * x.target_over_density;
}

}  // namespace

/// The state's technique and numbers are one of the ways to make its path. Over all of them the
/// target, in the numbers of technique s, is w_s f / p_s, and the numbers have the density p_s: so
/// given the path, s is distributed as its weight w_s, and the numbers as those that make it. So
/// drawing both anew, given the path, leaves the target unchanged (a Gibbs step).
/// Bitterli et al. (2018) propose a technique and then accept it with w_s' / w_s.
Transition MultiplexedStep::keep_path(const State& x, State& y, Rng& rng) {
  y.technique = x.technique;
  paths_.make_from(x.numbers, y, rng, &path_);
  const bool found = y.target > 0;
  y.clear();
  if (!found) return impossible;
  const bool strict = paths_.paths.settings().rules.strict_normals;
  compute_terms(*paths_.scene, path_, {true, strict}, terms_);
  const int k = path_.edges(), s = sample_technique(terms_, Heuristic::power, rng.next());
  if (s < 0) return impossible;
  const Technique technique{s, k + 1 - s};
  if (remake(x, x.technique, y, rng) && remake(x, technique, y, rng)) return {1, 1};
  y.clear();
  return impossible;
}

/// Makes y the same path by a technique; false if rounding has made another path of it. A step to a
/// technique without a step back would not leave the target unchanged, so that of x is tried too.
bool MultiplexedStep::remake(const State& x, const Technique& technique, State& y, Rng& rng) {
  y.technique = technique;
  if (!invert_path(*paths_.scene, path_, technique, rng, inverted_)) return false;
  paths_.make_from(inverted_, y, rng);
  return same_path(x, y);
}

}  // namespace mlt
