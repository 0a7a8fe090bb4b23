// The sums over the techniques that can make the path of a connection (TechniqueSums), along both
// of its subpaths.
#include "path/bidirectional_sampler.h"

namespace mlt {
namespace {

/// The sums over the techniques with a joint before or at vertex i of a subpath, from there to its
/// end: in coloured media densities by the other walk depend on all that it has flown before.
template <class CountTechnique>
TechniqueSums sum_back(const Scene& scene, const Subpath& walk, int i, double reverse,
                       Spectrum likelihood, CountTechnique&& count) {
  TechniqueSums sums;
  double quotient = reverse / walk[i].forward;
  while (quotient > 0) {
    sums = sums.with(TechniqueSums().with(count(i)).over(quotient));
    if (--i < 0) break;
    const double flown = fly_back(scene, walk[i + 1], likelihood);
    quotient *= walk[i].reverse * flown / walk[i].forward;
  }
  return sums;
}

}  // namespace

/// The techniques s = i, with their joint before vertex i of the light subpath. `joined`: vertex i
/// scatters smoothly, since the path is joined there.
TechniqueSums BidirectionalSampler::light_techniques(int i, bool joined) const {
  const TechniqueSums none;
  if (i == 0) return none.with(can_be_hit(*scene_, light_[0].vertex) ? 1 : 0);
  if (!joined && !connectable(light_[i].vertex)) return none;
  if (!connectable(light_[i - 1].vertex)) return none.with(manifold_count(i - 1, light_[i].vertex));
  if (i == 1) return none.with(light_direct_over_walk_);
  return none.with(1).with(i == 2 ? light_refracted_ : 0);
}

/// How often technique t = i counts, with its joint before vertex i of the camera subpath.
double BidirectionalSampler::camera_technique(int i, bool joined) const {
  if (i <= 1 && !settings_.light_image) return 0;
  if (i == 0) return lens_can_be_hit_ ? 1 : 0;
  return connectable(camera_[i - 1].vertex) && (joined || connectable(camera_[i].vertex)) ? 1 : 0;
}

/// Computes light_sums_ and camera_sums_ up to each vertex.
void BidirectionalSampler::sum_techniques(RayCounts& rays) {
  light_sums_.clear();
  camera_sums_.clear();
  const int lights = static_cast<int>(light_.size()), cameras = static_cast<int>(camera_.size());
  if (lights >= 2)
    light_direct_over_walk_ =
        direct_over_walk(light_[0].vertex, light_[0].forward, light_[1].vertex.at);
  light_refracted_ = 0;
  if (refracts_ && lights >= 3 && connectable(light_[1].vertex))
    light_refracted_ = refracted_over(light_[0].forward * light_[1].forward, light_[0].vertex,
                                      light_[1].vertex, light_[2].vertex, rays);
  if (scene_->has_coloured_media()) return;  // see sum_back()
  const Spectrum grey(1);
  for (int i = 0; i < lights; ++i)
    light_sums_.push_back(
        (i > 0 ? below_light(i - 1, light_[i - 1].reverse, grey) : TechniqueSums())
            .with(light_techniques(i)));
  for (int i = 0; i < cameras; ++i)
    camera_sums_.push_back(
        (i > 0 ? above_camera(i - 1, camera_[i - 1].reverse, grey) : TechniqueSums())
            .with(camera_technique(i)));
}

TechniqueSums BidirectionalSampler::below_light(int i, double reverse,
                                                const Spectrum& likelihood) const {
  if (!scene_->has_coloured_media()) return light_sums_[i].over(reverse / light_[i].forward);
  return sum_back(*scene_, light_, i, reverse, likelihood,
                  [&](int j) { return light_techniques(j); });
}
TechniqueSums BidirectionalSampler::above_camera(int i, double reverse,
                                                 const Spectrum& likelihood) const {
  if (!scene_->has_coloured_media()) return camera_sums_[i].over(reverse / camera_[i].forward);
  return sum_back(*scene_, camera_, i, reverse, likelihood,
                  [&](int j) { return camera_technique(j); });
}

}  // namespace mlt
