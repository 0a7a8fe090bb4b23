#include "primary/multiplexed_step.h"

#include "primary/invert_path.h"

namespace mlt {
namespace {

/// Inversion and a walk after it agree to rounding, which grows along a path.
constexpr double rounding = 0.01, rounding_in_pixels = 0.05;

/// f / P is the same whichever technique makes the path.
bool same_path(const MultiplexedState& x, const MultiplexedState& y) {
  return glm::length(y.raster - x.raster) < rounding_in_pixels &&
         std::abs(y.target_over_density - x.target_over_density) < rounding * x.target_over_density;
}

/// The technique s with the probability of its MIS weight; -1 if none can make the path.
int sample_weights(const PathTerms& terms, double u) {
  const int k = terms.edges();
  int last = -1;
  for (int s = 0; s <= k + 1; ++s) {
    const double weight = mis_weight(terms, s, Heuristic::power);
    if (!(weight > 0)) continue;
    last = s;
    if ((u -= weight) < 0) break;
  }
  return last;
}

}  // namespace

/// The state's technique and numbers are one of the ways to make its path. Over all of them the
/// target, in the numbers of technique s, is w_s f / p_s, and the numbers have the density p_s: so
/// given the path, s is distributed as its weight w_s, and the numbers as those that may have made
/// it. Drawing both anew from that leaves the target unchanged, whatever they were (a Gibbs step).
/// Bitterli et al. (2018) propose a technique and then accept it with w_s' / w_s.
Transition MultiplexedStep::keep_path(const State& x, State& y, Rng& rng) {
  y.numbers = x.numbers;
  y.technique = x.technique;
  y.clear();
  paths_(y, rng, path_);
  const bool found = y.target > 0;
  y.clear();
  if (!found) return impossible;
  const bool strict = paths_.paths.settings().rules.strict_normals;
  compute_terms(*paths_.scene, path_, {true, strict}, terms_);
  const int k = path_.edges(), s = sample_weights(terms_, rng.next());
  if (s < 0) return impossible;
  y.technique = {s, k + 1 - s};
  y.numbers.step(false);
  if (!invert_path(*paths_.scene, path_, y.technique, rng, y.numbers)) return impossible;
  paths_(y, rng);
  // Where rounding has made another path of it, the chain stays where it is.
  if (same_path(x, y)) return {1, 1};
  y.clear();
  return impossible;
}

}  // namespace mlt
