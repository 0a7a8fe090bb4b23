// Paths for inspection: those that one sample of path tracing or of bidirectional path tracing
// finds, each with its contribution to the image.
#pragma once

#include "path/bidirectional_sampler.h"
#include "path/path_tracer.h"

#include <vector>

namespace mlt {

struct FoundPath {
  Path path;
  int s = 0, t = 0;  ///< The technique that found it.
  Vec2 raster{0};
  /// f w / p, as radiance at `raster` that a film records (see shown()); the estimates with t >= 2
  /// of one sample add up to the sample.
  Color estimate{0};
};

/// The result of one sample of a pixel.
struct Replay {
  Vec2 raster{0};
  Color radiance{0};
  std::vector<FoundPath> paths;
};

/// The factor that turns f / p into radiance: importance integrates to 1 over the image, and
/// raster positions have their density over the sampled domain.
inline double radiance_scale(const Scene& scene) {
  return scene.camera().raster().pixels() / scene.camera().raster().sampled_area();
}

/// The linear sRGB of what a film of the scene has recorded.
inline Color shown(const Scene& scene, const Color& recorded) {
  const Camera& camera = scene.camera();
  return camera.response() * (camera.records_xyz() ? developed(recorded) : recorded);
}

/// A connection that `paths` has just found, with its path.
FoundPath found_path(const Scene& scene, const BidirectionalSampler& paths,
                     const Connection& connection);

/// Watches trace_path (see IgnorePaths) and records the paths that it finds.
class PathRecorder : public IgnorePaths {
 public:
  PathRecorder(const Vec2& raster, const SurfacePoint& lens, double time,
               std::vector<FoundPath>& found);

  void arrive(const SurfacePoint& at) { walk_.push_back(inner_vertex(at)); }
  void scatter(Lobe lobe) { walk_.back().lobe = lobe; }
  void hit(const Emitter& emitter, const SurfacePoint& x0, const Color& estimate) {
    keep(light_vertex(emitter, x0), false, estimate);
  }
  void connect(const LightSample& light, const Color& estimate) {
    if (light.x0.pdf > 0) keep(light_vertex(*light.emitter, light.x0.at), true, estimate);
  }
  void connect_between(const SurfacePoint& at, const LightSample& light, const Color& estimate) {
    arrive(at);
    connect(light, estimate);
    walk_.pop_back();
  }

 private:
  void keep(const Vertex& x0, bool connected, const Color& estimate);

  Vec2 raster_;
  double time_;
  std::vector<Vertex> walk_;  ///< Vertices of the walk, from the lens on.
  std::vector<FoundPath>* found_;
};

struct InspectSettings {
  uint64_t seed = 0;
  PathRules rules{10};  ///< Without roulette if max_depth is bounded.
};

/// A path through a pixel: samples of path tracing without roulette are taken until one finds
/// light; of the paths that it has found one is chosen in proportion to the L* of its estimate.
/// Throws RenderError if there is no light in ten thousand samples.
FoundPath trace_path_through(const Scene& scene, const Vec2i& pixel,
                             const InspectSettings& settings);

/// A path anywhere on the image, found by any technique of bidirectional path tracing, and chosen
/// in proportion to the L* of its estimate.
FoundPath sample_path(const Scene& scene, const InspectSettings& settings);

}  // namespace mlt
