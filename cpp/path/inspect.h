// Paths to look at: those that one sample of path tracing or of bidirectional path tracing finds,
// each as a value with what it brings to the image.
#pragma once

#include "path/bidirectional_sampler.h"
#include "path/path_tracer.h"

#include <vector>

namespace mlt {

struct FoundPath {
  Path path;
  int s = 0, t = 0;  ///< The technique that found it.
  Vec2 raster{0};
  /// f w / p, as the radiance that the sample has shown at `raster`; those with t >= 2 of one
  /// sample add up to the sample.
  Color estimate{0};
};

/// What one sample of a pixel has seen.
struct Replay {
  Vec2 raster{0};
  Color radiance{0};
  std::vector<FoundPath> paths;
};

/// By what f / p is to be multiplied to be a radiance: importance integrates to 1 over the image,
/// and raster positions have their density over the sampled domain.
inline double radiance_scale(const Scene& scene) {
  return scene.camera().raster().pixels() / scene.camera().raster().sampled_area();
}

/// A connection that `paths` has just found, as a value.
FoundPath found_path(const Scene& scene, const BidirectionalSampler& paths,
                     const Connection& connection);

/// Watches trace_path (see IgnorePaths) and keeps the paths that it finds.
class PathRecorder : public IgnorePaths {
 public:
  PathRecorder(const Scene& scene, const Vec2& raster, const SurfacePoint& lens, double time,
               std::vector<FoundPath>& found);

  void arrive(const SurfacePoint& at) { walk_.push_back(surface_vertex(at)); }
  void scatter(Lobe lobe) { walk_.back().lobe = lobe; }
  void hit(const Emitter& emitter, const SurfacePoint& x0, const Vec3& w, const Color& throughput);
  void connect(const Vec3& u_light, const Color& estimate);

 private:
  void keep(const Vertex& x0, bool connected, const Color& estimate);

  const Scene* scene_;
  Vec2 raster_;
  double time_;
  std::vector<Vertex> walk_;  ///< From the lens.
  std::vector<FoundPath>* found_;
};

struct InspectSettings {
  uint64_t seed = 0;
  PathRules rules{10};  ///< Roulette only if there is no longest path.
};

/// A path through a pixel: samples of path tracing without roulette are taken until one finds
/// light; of the paths that it has found one is chosen in proportion to the L* of its estimate.
/// Throws RenderError if there is no light in ten thousand samples.
FoundPath trace_path_through(const Scene& scene, const Vec2i& pixel,
                             const InspectSettings& settings);

/// The same anywhere on the image, by all techniques of bidirectional path tracing.
FoundPath sample_path(const Scene& scene, const InspectSettings& settings);

}  // namespace mlt
