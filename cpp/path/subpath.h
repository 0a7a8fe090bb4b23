// Random walks from a light and from the camera, with the densities of every vertex for both
// directions of travel cached on the way.
#pragma once

#include "path/path_rules.h"
#include "path/samplers.h"
#include "path/walk.h"

#include <vector>

namespace mlt {

/// One vertex of a subpath; number 0 is the end of the path (on the light, or on the lens).
struct WalkVertex {
  Vertex vertex;             ///< Its lobe is the one by which the walk went on.
  Color throughput{0};       ///< alpha: f / p of everything before this vertex scatters.
  Color next_throughput{0};  ///< alpha of the next vertex.
  /// Probability that Russian roulette lets the walk come here, and to the next vertex.
  double survival = 1, next_survival = 1;
  Vec3 towards_previous{0};
  Vec3 towards_next{0};  ///< As sampled; meaningless if `absorbed`.
  double G = 0;          ///< G between this vertex and the previous one.
  double forward = 0;    ///< Density of this vertex, made by this walk.
  double reverse = 0;    ///< Density of this vertex, made by a walk from the other end (if known).
  /// Density of towards_next in projected solid angle, for this walk.
  double next_coefficient = 0;

  /// Where a path may be joined to a matte vertex, what all its joints have in common.
  struct MatteJoint {
    /// Of towards_previous against the shading normal; 0: nothing is scattered to or from there.
    double cosine = 0;
    Color value{0};   ///< Throughput times f, for joints of a camera walk without |w.ns| / |w.ng|.
    double back = 0;  ///< Density of towards_previous in projected solid angle.
  };
  MatteJoint matte;

  bool absorbed() const { return next_coefficient == 0; }  ///< No direction was sampled here.
};

/// How far a walk goes at most.
struct WalkLength {
  int vertices;
  bool goes_on;  ///< A direction is drawn at the last vertex, too.
};

class Subpath {
 public:
  enum class From { light, camera };

  explicit Subpath(From from) : from_(from) {}

  size_t size() const { return size_; }
  const WalkVertex& operator[](size_t i) const { return vertices_[i]; }
  From from() const { return from_; }
  /// With which the walk left its end; for a light at infinity it starts outside the scene.
  const Ray& first_ray() const { return first_ray_; }

  void clear() { size_ = 0; }
  /// Starts at an end whose position has this density; returns the vertex to be given its first
  /// direction.
  void start(const Vertex& end, double position_pdf);

  /// Walks on from the first vertex until it is absorbed or long enough. Camera walks end in a
  /// vertex at infinity when they leave the scene among lights that are there.
  template <class Sampler>
  void walk(const Walker& walker, const PathRules& rules, const Departure& first,
            const WalkLength& most, Sampler& sampler) {
    first_ray_ = first.ray;
    leave(walker.scene, first.ray.d, first.pdf);
    Ray ray = first.ray;
    goes_on_ = true;
    while (static_cast<int>(size()) < most.vertices) {
      goes_on_ = false;
      if (!trace(walker, rules, ray)) return;
      if (static_cast<int>(size()) == most.vertices && !most.goes_on) return;
      const Vec2 u_direction = sampler.next2();
      const double u_lobe = sampler.next();
      const double u_roulette = rules.rr_depth == PathRules::no_roulette ? 0 : sampler.next();
      if (!scatter(walker, rules, {u_lobe, u_direction}, u_roulette)) return;
      ray = walker.leave(last().vertex.at, last().towards_next);
      goes_on_ = true;
    }
  }
  /// Whether a direction was drawn at the last vertex, but not followed.
  bool goes_on() const { return goes_on_; }

 private:
  /// Adds the vertex that the ray ends in; false if the walk ends there or finds none.
  bool trace(const Walker& walker, const PathRules& rules, const Ray& ray);
  /// Where the walk has arrived at a matte surface.
  void prepare_joints(WalkVertex& x, bool strict_normals) const;
  /// Samples a direction at the last vertex; false if the walk ends there.
  bool scatter(const Walker& walker, const PathRules& rules, const Vec3& u, double u_roulette);
  struct Step {
    Vec3 w;              ///< The direction that was sampled,
    double coefficient;  ///< its density in projected solid angle,
    Color ratio;         ///< and f over that.
  };
  bool scatter(const Walker& walker, WalkVertex& x, const Vec3& u, bool strict, Step& step);
  bool scatter_matte(const WalkVertex& x, const Vec2& u, bool strict, Step& step) const;
  /// Fixes the direction in which the end vertex is left.
  void leave(const Scene& scene, const Vec3& w, double coefficient);

  WalkVertex& last() { return vertices_[size_ - 1]; }
  /// A new vertex, absorbed until more is known.
  WalkVertex& add();

  From from_;
  Ray first_ray_{};
  bool goes_on_ = false;
  size_t size_ = 0;
  std::vector<WalkVertex> vertices_;  ///< Those after the first size_ only keep memory.
};

/// A subpath from a random point of a light.
template <class Sampler>
void walk_from_light(const Walker& walker, const PathRules& rules, const WalkLength& most,
                     Sampler& sampler, Subpath& subpath) {
  subpath.clear();
  sampler.begin(Stream::light);
  const Vec2 u_position = sampler.next2(), u_direction = sampler.next2();
  const LightSample light =
      sample_light_position(walker.scene, {sampler.next(), u_position}, walker.time);
  if (!(light.x0.pdf > 0)) return;
  const Vertex x0 = light_vertex(*light.emitter, light.x0.at);
  subpath.start(x0, light.x0.pdf);
  const Departure first = walker.leave_light(x0, u_direction);
  if (first.pdf > 0) subpath.walk(walker, rules, first, most, sampler);
}

}  // namespace mlt
