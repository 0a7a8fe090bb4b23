#include "mutation/manifold_chain.h"

namespace mlt {

bool ManifoldChain::can_be_walked(const Scene& scene, const PathState& x) const {
  if (count() < 1 || count() > SpecularChain::most_vertices || x[c].delta()) return false;
  for (int i = c + 1; i < b; ++i)
    if (!has_constraint(scene, x[i])) return false;
  return true;
}

bool ManifoldChain::follow(ManifoldWalk& walk, const Scene& scene, const PathState& x,
                           const SurfacePoint& end, MutationContext& context) const {
  return walk.start(scene, &x[c], count()) &&
         (end.wavelength == x.path.wavelength ||
          walk.change_wavelength(end.wavelength, x.path.time, context.rays)) &&
         walk.go(end, x.path.time, context.rays);
}

bool ManifoldChain::find(const Scene& scene, const PathState& x, PathState& y,
                         MutationContext& context) const {
  ManifoldWalk walk;
  if (!follow(walk, scene, x, y[b].at, context)) {
    ++context.failures.there;
    return false;
  }
  for (int i = 0; i < walk.count(); ++i) y.path[c + 1 + i] = walk[i];
  return true;
}

bool ManifoldChain::leads_back(const Scene& scene, const PathState& x, const PathState& y,
                               MutationContext& context) const {
  ManifoldWalk walk;
  if (follow(walk, scene, y, x[b].at, context) && walk.ended_in(&x[c])) return true;
  ++context.failures.back;
  return false;
}

}  // namespace mlt
