// Paths from the camera that are traced side by side: all take their first step, then all take the
// second one. The accelerator gets their rays in packets, and matte vertices are computed together.
// Every path is that of trace_path, up to rounding.
// S. Laine, T. Karras, T. Aila, "Megakernels considered harmful: wavefront path tracing on GPUs",
// High-Performance Graphics 2013.
#pragma once

#include "path/matte_vertices.h"
#include "path/path_tracer.h"
#include "path/samplers.h"

namespace mlt {

class Wavefront {
 public:
  static constexpr size_t capacity = MatteVertices::capacity;

  Wavefront(const Scene& scene, const PathRules& rules, Heuristic heuristic = Heuristic::power)
      : scene_(&scene), rules_(rules), heuristic_(heuristic) {
    walks_.reserve(capacity);
    samplers_.reserve(capacity);
  }

  /// A path that begins with `ray`; `sampler` goes on from there. For `chain_factor` see CameraWalk.
  void add(const Ray& ray, const PixelSampler& sampler, double chain_factor = 0) {
    walks_.emplace_back(ray);
    walks_.back().heuristic = heuristic_;
    walks_.back().chain_factor = chain_factor;
    samplers_.push_back(sampler);
  }
  size_t size() const { return walks_.size(); }
  bool full() const { return size() == capacity; }
  /// Traces all of them to their ends.
  void trace(RayCounts& rays);
  /// With what it has found.
  const CameraWalk& operator[](size_t i) const { return walks_[i]; }
  void clear() {
    walks_.clear();
    samplers_.clear();
  }

 private:
  /// Light that arrives where nothing is in its way.
  struct Shadows {
    RayPacket packet;
    std::array<int, RayPacket::size> walk;
    std::array<Color, RayPacket::size> radiance;
    std::array<double, RayPacket::size> own_share;
  };

  void find_hits(RayCounts& rays);
  void find_vertex(int walk, const Hit& hit, int depth, RayCounts& rays);
  void find_matte_vertex(int walk, const Mesh& mesh, const Hit& hit);
  void find_other_vertex(int walk, const SurfacePoint& at, int depth, RayCounts& rays);
  void scatter_matte(int depth, RayCounts& rays);
  void choose_light(int i, const Vec3& u, RayCounts& rays);
  void queue_lights(RayCounts& rays);
  void queue_light(int walk, const SurfacePoint& at, const Vec3& u, RayCounts& rays);
  template <class... Segment>
  void queue_shadow(int walk, const Color& radiance, RayCounts& rays, const Segment&... segment);
  void find_shadows();
  bool go_on(int i, int depth);

  const Scene* scene_;
  PathRules rules_;
  Heuristic heuristic_;
  std::vector<CameraWalk> walks_;
  std::vector<PixelSampler> samplers_;
  std::vector<int> live_;               ///< The walks that take this step;
  std::array<bool, capacity> goes_on_;  ///< those that take the next one.
  std::vector<Hit> hits_;               ///< Of the live ones.
  MatteVertices matte_;
  Shadows shadows_;
};

}  // namespace mlt
