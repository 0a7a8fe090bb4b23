#include "path/inspect.h"

#include "base/error.h"
#include "path/samplers.h"

#include <algorithm>

namespace mlt {
namespace {

constexpr uint64_t most_samples = 10000;

/// The rules without roulette, unless nothing else ends a walk.
PathRules without_roulette(PathRules rules) {
  rules.rr_depth = rules.max_depth < 0 ? 5 : rules.max_depth;
  return rules;
}

std::vector<FoundPath> traced(const Scene& scene, const PathRules& rules, const Vec2& raster,
                              RandomSampler& sampler) {
  std::vector<FoundPath> found;
  RayCounts rays;
  const auto [lens, ray] = camera_ray(scene.camera(), raster, sampler);
  PathRecorder recorder(raster, lens.at, ray.time, found);
  trace_path(scene, without_roulette(rules), ray, sampler, rays, recorder);
  return found;
}

std::vector<FoundPath> connected(const Scene& scene, const PathRules& rules, const Vec2& raster,
                                 RandomSampler& sampler) {
  std::vector<FoundPath> found;
  RayCounts rays;
  BidirectionalSampler paths(scene, {without_roulette(rules)});
  paths.sample(raster, sampler, rays);
  paths.connect_all(rays,
                    [&](const Connection& c) { found.push_back(found_path(scene, paths, c)); });
  return found;
}

/// One of the paths, chosen by weight; nullptr if there is none with a weight.
FoundPath* choose(std::vector<FoundPath>& found, RandomSampler& sampler) {
  const auto weight = [](const FoundPath& path) {
    const double w = target_luminance(path.estimate);
    return std::isfinite(w) && w > 0 ? w : 0.0;
  };
  double sum = 0;
  for (const FoundPath& path : found) sum += weight(path);
  double u = sampler.next() * sum;
  FoundPath* last = nullptr;
  for (FoundPath& path : found)
    if (weight(path) > 0) {
      last = &path;
      if ((u -= weight(path)) < 0) break;
    }
  return last;
}

/// Tries samples until one finds light; `sample(sampler)` returns the paths of one.
template <class Sample>
FoundPath first_found(uint64_t seed, const std::string& where, Sample&& sample) {
  for (uint64_t i = 0; i < most_samples; ++i) {
    Rng rng(seed, Purpose::inspect, i);
    RandomSampler sampler(rng);
    std::vector<FoundPath> found = sample(sampler);
    if (FoundPath* chosen = choose(found, sampler)) return std::move(*chosen);
  }
  throw RenderError("no light path found " + where + " in " + std::to_string(most_samples) +
                    " samples; is it dark there, or max_depth too small?");
}

}  // namespace

FoundPath found_path(const Scene& scene, const BidirectionalSampler& paths,
                     const Connection& connection) {
  FoundPath found;
  paths.assemble(connection, found.path);
  found.s = connection.s;
  found.t = connection.t;
  found.raster = connection.raster;
  found.estimate = connection.contribution * (connection.weight * radiance_scale(scene));
  return found;
}

PathRecorder::PathRecorder(const Vec2& raster, const SurfacePoint& lens, double time,
                           std::vector<FoundPath>& found)
    : raster_(raster), time_(time), walk_{camera_vertex(lens)}, found_(&found) {}

void PathRecorder::keep(const Vertex& x0, bool connected, const Color& estimate) {
  if (is_black(estimate)) return;
  FoundPath found;
  found.path.time = time_;
  found.path.wavelength = walk_[0].at.wavelength;
  found.path.vertices.push_back(x0);
  found.path.vertices.insert(found.path.vertices.end(), walk_.rbegin(), walk_.rend());
  found.s = connected ? 1 : 0;
  found.t = found.path.edges() + 1 - found.s;
  found.raster = raster_;
  found.estimate = estimate;
  found_->push_back(std::move(found));
}

FoundPath trace_path_through(const Scene& scene, const Vec2i& pixel,
                             const InspectSettings& settings) {
  const std::string where =
      "through pixel (" + std::to_string(pixel.x) + ", " + std::to_string(pixel.y) + ")";
  return first_found(settings.seed, where, [&](RandomSampler& sampler) {
    return traced(scene, settings.rules, Vec2(pixel) + sampler.next2(), sampler);
  });
}

FoundPath sample_path(const Scene& scene, const InspectSettings& settings) {
  return first_found(settings.seed, "on the image", [&](RandomSampler& sampler) {
    return connected(scene, settings.rules, scene.camera().raster().sample(sampler.next2()),
                     sampler);
  });
}

}  // namespace mlt
