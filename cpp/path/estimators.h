// Estimators of the image: path tracing, bidirectional path tracing, light tracing. Each takes one
// sample, with the random numbers of any sampler, and calls found(FoundLight) for each of its
// paths. They render alone (EstimatorTaker), or beside chains (beside_chains.h), give chains their
// starts (EstimatorSource), and chains of pssmlt move their numbers.
#pragma once

#include "path/found_light.h"
#include "path/inspect.h"

#include <vector>

namespace mlt {

/// Watches walks from the camera as `Watcher` does, and tells what they find.
template <class Watcher, class Found>
struct LightFinder : Watcher {
  LightFinder(const Watcher& watcher, Found& f, const Vec2& r)
      : Watcher(watcher), found(f), raster(r) {}
  double find(const CameraWalk& walk, const Color& radiance, double certainty) const {
    found(FoundLight{{raster, radiance, true}, walk.survival, certainty});
    return 1;
  }
  Found& found;
  Vec2 raster;
};

/// An estimator has
///
///     template <class Sampler, class Found>
///     void operator()(const Vec2& raster, Sampler&, RayCounts&, Found&& found);
///
/// and the light that it finds at its own position, times own_scale(), is radiance.
struct Estimator {
  double own_scale() const { return 1; }
  /// Where the paths of a sample are recorded, for a replay or to know their layers.
  std::vector<FoundPath>* paths = nullptr;

 protected:
  /// Calls trace(watcher) for a sample that begins at this ray; the watcher tells what is found,
  /// and records it.
  template <class Found, class Trace>
  void watch(const Vec2& raster, const CameraRay& start, Found& found, Trace&& trace) const {
    if (paths)
      trace(LightFinder<PathRecorder, Found>{
          {raster, start.lens.at, start.ray.time, *paths}, found, raster});
    else
      trace(LightFinder<IgnorePaths, Found>{{}, found, raster});
  }
};

class PathEstimator : public Estimator {
 public:
  /// Only with the balance heuristic is f / P, and so a weight beside chains, known.
  PathEstimator(const Scene& scene, const PathRules& rules, Heuristic heuristic = Heuristic::power)
      : scene_(&scene), rules_(rules), heuristic_(heuristic) {}

  template <class Sampler, class Found>
  void operator()(const Vec2& raster, Sampler& sampler, RayCounts& rays, Found&& found) const {
    const CameraRay start = camera_ray(scene_->camera(), raster, sampler);
    CameraWalk walk(start.ray);
    walk.mis = MisExponent(heuristic_);
    walk.certainty = heuristic_ == Heuristic::balance;
    watch(raster, start, found,
          [&](auto&& watcher) { trace_path(*scene_, rules_, walk, sampler, rays, watcher); });
  }

 private:
  const Scene* scene_;
  PathRules rules_;
  Heuristic heuristic_;
};

/// An estimator with all techniques (s, t).
class BidirectionalEstimator : public Estimator {
 public:
  BidirectionalEstimator(const Scene& scene, const BidirectionalSettings& settings)
      : scene_(&scene), paths_(scene, settings) {}
  BidirectionalEstimator(const Scene& scene, const PathRules& rules)
      : BidirectionalEstimator(scene, BidirectionalSettings{rules}) {}

  double own_scale() const { return radiance_scale(*scene_); }

  template <class Sampler, class Found>
  void operator()(const Vec2& raster, Sampler& sampler, RayCounts& rays, Found&& found) {
    connect_all(raster, sampler, rays, [&](const Connection& c) {
      found(FoundLight{
          {c.raster, c.contribution * c.weight, c.t >= 2}, c.own_share / c.weight, c.certainty});
    });
  }
  /// As above, but calls found(Connection).
  template <class Sampler, class Found>
  void connect_all(const Vec2& raster, Sampler& sampler, RayCounts& rays, Found&& found) {
    paths_.sample(raster, sampler, rays);
    paths_.connect_all(rays, [&](const Connection& c) {
      found(c);
      if (paths) paths->push_back(found_path(*scene_, paths_, c));
    });
  }

 private:
  const Scene* scene_;
  BidirectionalSampler paths_;
};

/// An estimator with the technique t = 1 alone.
class LightEstimator : public Estimator {
 public:
  LightEstimator(const Scene& scene, const PathRules& rules)
      : scene_(&scene), paths_(scene, {rules}) {}

  template <class Sampler, class Found>
  void operator()(const Vec2&, Sampler& sampler, RayCounts& rays, Found&& found) {
    paths_.sample_light(sampler, rays);
    paths_.connect_to_lens(rays, [&](Connection c) {
      c.weight = 1;
      found(FoundLight{{c.raster, c.contribution, false}});
      if (paths) paths->push_back(found_path(*scene_, paths_, c));
    });
  }

 private:
  const Scene* scene_;
  BidirectionalSampler paths_;
};

}  // namespace mlt
