// Random walks from a light and from the camera, with the densities of every vertex for both
// directions of travel cached on the way.
#pragma once

#include "path/next_event.h"
#include "path/path.h"
#include "path/ray_counts.h"
#include "path/scatter.h"

#include <vector>

namespace mlt {

/// One vertex of a subpath; number 0 is the end of the path (on the light, or on the lens).
struct WalkVertex {
  Vertex vertex;             ///< As an end to connect to: its lobe is smooth.
  Lobe lobe = Lobe::smooth;  ///< How the walk went on from here.
  Color throughput{0};       ///< alpha: f / p of everything before this vertex scatters.
  Color next_throughput{0};  ///< alpha of the next vertex.
  Vec3 towards_previous{0};
  Vec3 towards_next{0};  ///< As sampled; meaningless if `absorbed`.
  bool absorbed = true;  ///< No direction was sampled here.
  double G = 0;          ///< G between this vertex and the previous one.
  double forward = 0;    ///< Density of this vertex, made by this walk.
  double reverse = 0;    ///< Density of this vertex, made by a walk from the other end (if known).
  double next_coefficient =
      0;  ///< Density of towards_next in projected solid angle, for this walk.
};

struct WalkSettings {
  int max_vertices = 1 << 16;
  int rr_depth = 5;
  bool strict_normals = false;
};

class Subpath {
 public:
  enum class From { light, camera };

  explicit Subpath(From from) : from_(from) {}

  size_t size() const { return vertices_.size(); }
  const WalkVertex& operator[](size_t i) const { return vertices_[i]; }
  const WalkVertex* data() const { return vertices_.data(); }
  From from() const { return from_; }
  /// With which the walk left its end; for a light at infinity it starts outside the scene.
  const Ray& first_ray() const { return first_ray_; }

  void clear() { vertices_.clear(); }
  /// Starts at an end whose position has this density; returns the vertex to be given its first
  /// direction.
  void start(const Vertex& end, double position_pdf);

  /// Walks on from the first vertex along `ray`, whose direction has density `coefficient` in
  /// projected solid angle at the end vertex, until it is absorbed or has max_vertices. Camera walks
  /// end in a vertex at infinity when they leave the scene among lights that are there.
  template <class Sampler>
  void walk(const Scene& scene, const WalkSettings& settings, Ray ray, double coefficient,
            Sampler& sampler, RayCounts& rays) {
    first_ray_ = ray;
    leave(scene, ray.d, coefficient);
    while (static_cast<int>(size()) < settings.max_vertices && trace(scene, ray, rays)) {
      // A light walk may still hit the lens from its last vertex.
      if (from_ == From::camera && static_cast<int>(size()) == settings.max_vertices) break;
      const Vec2 u_direction = sampler.next2();
      const double u_lobe = sampler.next(), u_roulette = sampler.next();
      if (!scatter(scene, settings, {u_lobe, u_direction}, u_roulette)) break;
      ray = scene.spawn(vertices_.back().vertex.at, vertices_.back().towards_next, ray.time);
    }
  }

 private:
  /// Adds the vertex that the ray ends in; false if the walk ends there or finds none.
  bool trace(const Scene& scene, const Ray& ray, RayCounts& rays);
  /// Samples a direction at the last vertex; false if the walk ends there.
  bool scatter(const Scene& scene, const WalkSettings& settings, const Vec3& u, double u_roulette);
  /// Fixes the direction in which the end vertex is left.
  void leave(const Scene& scene, const Vec3& w, double coefficient);
  void append(const SurfacePoint& at, const Vec3& towards_previous);

  From from_;
  Ray first_ray_{};
  std::vector<WalkVertex> vertices_;
};

/// A subpath of the light that next-event estimation has chosen, or that a light walk starts from.
template <class Sampler>
void walk_from_light(const Scene& scene, const WalkSettings& settings, double time,
                     Sampler& sampler, Subpath& subpath, RayCounts& rays) {
  subpath.clear();
  const Vec2 u_position = sampler.next2(), u_direction = sampler.next2();
  double u_choice = sampler.next();
  const EmitterChoice choice = scene.choose_emitter(u_choice);
  const PositionSample position = choice.emitter->sample_position(u_position);
  if (!(position.pdf > 0)) return;
  subpath.start(light_vertex(*choice.emitter, position.at), choice.probability * position.pdf);
  const RaySample sample = choice.emitter->sample_ray(position.at, u_direction);
  if (!(sample.pdf > 0)) return;
  Ray ray = position.at.infinite() ? Ray{sample.origin, sample.direction, time}
                                   : scene.spawn(position.at, sample.direction, time);
  subpath.walk(scene, settings, ray, sample.pdf, sampler, rays);
}

/// A subpath from a point on the lens through a raster position.
template <class Sampler>
void walk_from_camera(const Scene& scene, const WalkSettings& settings, const Vec2& raster,
                      const Vec2& u_lens, double time, Sampler& sampler, Subpath& subpath,
                      RayCounts& rays) {
  subpath.clear();
  const Camera& camera = scene.camera();
  const PositionSample lens = camera.sample_position(u_lens);
  subpath.start(camera_vertex(lens.at), lens.pdf);
  const Vec3 w = camera.direction(lens.at, raster);
  subpath.walk(scene, settings, {lens.at.p, w, time}, camera.pdf_direction(lens.at, w), sampler,
               rays);
}

}  // namespace mlt
