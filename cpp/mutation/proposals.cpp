#include "mutation/proposals.h"

#include "base/error.h"
#include "mutation/mixture.h"

namespace mlt {

std::vector<Proposal> propose(const Scene& scene, const MutationSettings& settings,
                              const Path& path, const std::shared_ptr<const Mutation>& mutation,
                              uint64_t seed, int count) {
  PathState x;
  x.path = path;
  evaluate(scene, settings, x);
  if (!(x.target > 0))
    throw UsageError("the path carries no light that the mutation's settings allow");
  if (!(mutation->suitability(x) > 0))
    throw UsageError("the " + mutation->name() + " mutation does not act on a path " +
                     signature(scene, path, settings.near_specular));
  RayCounts rays;
  Rng rng(seed, Purpose::inspect, 0);
  const Mutations alone = {mutation};
  const MutationChoice choice(std::vector<double>{1.0});
  MutationMixture kernel(alone, choice, rays);
  std::array<PathState, 1> y;
  std::vector<Proposal> proposals;
  for (int i = 0; i < count; ++i) {
    kernel.set_stratified_raster(unstratified(scene.camera().raster(), rng));
    const double a = acceptance(kernel.propose(x, y, 0, rng));
    if (kernel.generated()) proposals.push_back({y[0], a});
  }
  return proposals;
}

}  // namespace mlt
