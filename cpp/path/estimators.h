// Estimators of the image: path tracing, bidirectional path tracing, light tracing. Each takes one
// sample, with the random numbers of any sampler, and calls found(FoundLight) for each of its
// paths. They render alone (EstimatorTaker), or beside chains (beside_chains.h), give chains their
// starts (EstimatorSource), and chains of pssmlt move their numbers.
#pragma once

#include "path/found_light.h"
#include "path/inspect.h"

#include <vector>

namespace mlt {

/// An estimator has
///
///     template <class Sampler, class Found>
///     void operator()(const Vec2& raster, Sampler&, RayCounts&, Found&& found);
///
/// and the light that it finds at its own position, times own_scale(), is radiance.
struct Estimator {
  double own_scale() const { return 1; }
  /// Where the paths of a sample are recorded for a replay, by those that can.
  std::vector<FoundPath>* paths = nullptr;
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
    const auto trace = [&](auto&& watcher) {
      trace_path(*scene_, rules_, walk, sampler, rays, watcher);
    };
    if (paths)
      trace(Finder<PathRecorder, Found>{
          {*scene_, raster, start.lens.at, start.ray.time, *paths}, found, raster});
    else
      trace(Finder<IgnorePaths, Found>{{}, found, raster});
  }

 private:
  template <class Watcher, class Found>
  struct Finder : Watcher {
    Finder(const Watcher& watcher, Found& f, const Vec2& r)
        : Watcher(watcher), found(f), raster(r) {}
    double find(const CameraWalk& walk, const Color& radiance, double certainty) const {
      found(FoundLight{{raster, radiance, true}, walk.survival, certainty});
      return 1;
    }
    Found& found;
    Vec2 raster;
  };

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
