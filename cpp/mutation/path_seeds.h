// Light paths to start chains from, drawn by bidirectional path tracing. One candidate is one sample of
// it: several paths, each with the weight L*(x) mis(x) / p(x).
#pragma once

#include "mutation/path_state.h"
#include "path/bidirectional_sampler.h"
#include "path/samplers.h"

namespace mlt {

class PathSeeds {
 public:
  PathSeeds(const Scene& scene, const BidirectionalSettings& paths,
            const MutationSettings& settings)
      : scene_(&scene), settings_(&settings), paths_(scene, paths) {}

  /// Sum of the weights of a candidate's paths; `seen(raster, weight)` is called for each.
  template <class Seen>
  double weigh(Rng& rng, RayCounts& rays, Seen&& seen) {
    double sum = 0;
    draw(rng, rays, [&](const Connection& connection, double weight) {
      sum += weight;
      seen(connection.raster, weight);
    });
    return sum;
  }

  /// One of a candidate's paths, chosen in proportion to its weight.
  PathState pick(Rng& rng, Rng& choice, RayCounts& rays) {
    PathState x;
    double sum = 0;
    draw(rng, rays, [&](const Connection& connection, double weight) {
      sum += weight;
      if (choice.next() * sum < weight) paths_.assemble(connection, x.path);
    });
    if (!x.path.vertices.empty()) evaluate(*scene_, *settings_, x);
    return x;
  }

  /// Calls found(connection, weight) for each path of a candidate.
  template <class Found>
  void draw(Rng& rng, RayCounts& rays, Found&& found) {
    RandomSampler sampler(rng);
    paths_.sample(scene_->camera().raster().sample(sampler.next2()), sampler, rays);
    paths_.connect_all(rays, [&](const Connection& c) {
      double weight = target_luminance(c.contribution) * c.weight;
      if (settings_->map) weight *= (*settings_->map)(c.raster);
      if (std::isfinite(weight) && weight > 0) found(c, weight);
    });
  }

  /// The path of a connection that was just found.
  void assemble(const Connection& connection, PathState& x) const {
    paths_.assemble(connection, x.path);
    evaluate(*scene_, *settings_, x);
  }

 private:
  const Scene* scene_;
  const MutationSettings* settings_;
  BidirectionalSampler paths_;
};

}  // namespace mlt
