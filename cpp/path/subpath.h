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
  Vertex vertex;                ///< With the lobe by which the walk was scattered.
  Spectrum throughput{0};       ///< alpha: f / p of everything before this vertex scatters.
  Spectrum next_throughput{0};  ///< alpha of the next vertex.
  bool dispersed = false, next_dispersed = false;  ///< Whether any of these vertices disperses.
  /// Probability of surviving Russian roulette up to here, and up to the next vertex.
  double survival = 1, next_survival = 1;
  Vec3 towards_previous{0};
  Vec3 towards_next{0};  ///< As sampled; meaningless if `absorbed`.
  double G = 0;          ///< G between this vertex and the previous one.
  /// The probability that a walk from the previous vertex in this direction stops here.
  double passes = 1;
  Spectrum passed{1};      ///< Transmittance of the way here, over `passes`.
  Spectrum likelihood{1};  ///< Likelihood of the walk after that (see Passage).
  /// The arrival from here of a walk from the other end, and what of its probability is known: all
  /// in grey media; in coloured ones that is without what it flies, which its likelihood decides.
  Arrival back;
  double passes_back = 1;
  double forward = 0;  ///< Density of this vertex, made by this walk.
  double reverse = 0;  ///< Density of this vertex, made by a walk from the other end (if known).
  /// Density of towards_next in projected solid angle, for this walk.
  double next_coefficient = 0;

  /// The terms that all joints of a vertex have in common, where they are known on arrival: on
  /// Lambertian surfaces.
  struct Joint {
    bool known = false;
    /// Cosine of towards_previous with the shading normal; 0: nothing is scattered there.
    double cosine = 0;
    Spectrum value{
        0};           ///< Throughput times f, for joints of a camera walk without |w.ns| / |w.ng|.
    double back = 0;  ///< Density of towards_previous in projected solid angle.
  };
  Joint joint;

  /// Density of the previous vertex, made by a walk from the other end through this one, where the
  /// coefficient is that of its direction; see passes_back.
  double density_back(double coefficient) const { return coefficient * G * passes_back; }
  bool absorbed() const { return next_coefficient == 0; }  ///< No direction was sampled here.
};

/// The greatest length of a walk.
struct WalkLength {
  int vertices;
  bool goes_on;  ///< Whether a direction is drawn at the last vertex, too.
};

class Subpath {
 public:
  enum class From { light, camera };

  explicit Subpath(From from) : from_(from) {}

  size_t size() const { return size_; }
  const WalkVertex& operator[](size_t i) const { return vertices_[i]; }
  From from() const { return from_; }
  /// The ray from the end of the walk; for a light at infinity it starts outside the scene.
  const Ray& first_ray() const { return first_ray_; }

  void clear() { size_ = 0; }
  /// Starts at an end whose position has this density; its first direction is to be set later.
  void start(const Vertex& end, double position_pdf);

  /// Walks on from the first vertex until it is absorbed or long enough. Camera walks end in a
  /// vertex at infinity when they leave the scene, if there are lights at infinity.
  template <class Sampler>
  void walk(const Walker& walker, const PathRules& rules, const Departure& first,
            const WalkLength& most, Sampler& sampler) {
    first_ray_ = first.ray;
    leave(walker.scene, first.ray.d, first.pdf);
    Ray ray = first.ray;
    goes_on_ = true;
    while (static_cast<int>(size()) < most.vertices) {
      goes_on_ = false;
      if (!trace(walker, rules, ray, walker.draw_leg(sampler))) return;
      if (static_cast<int>(size()) == most.vertices && !most.goes_on) return;
      if (!scatter(walker, rules, StepNumbers::draw(sampler))) return;
      ray = walker.leave(last().vertex.at, last().towards_next);
      goes_on_ = true;
    }
  }
  /// Whether a direction was drawn at the last vertex, but not followed.
  bool goes_on() const { return goes_on_; }

 private:
  /// Adds the vertex that the ray hits; false if the walk ends there or the ray hits none.
  bool trace(const Walker& walker, const PathRules& rules, const Ray& ray, double u_leg);
  /// Takes what was passed on the way to the last vertex.
  void pass(const Scene& scene, const Passage& leg);
  /// Computes the terms for joints at a Lambertian vertex.
  void prepare_joints(WalkVertex& x, bool strict_normals);
  /// Samples a direction at the last vertex; false if the walk ends there.
  bool scatter(const Walker& walker, const PathRules& rules, const StepNumbers& u);
  /// Sets the direction of the walk from its end vertex.
  void leave(const Scene& scene, const Vec3& w, double coefficient);

  WalkVertex& last() { return vertices_[size_ - 1]; }
  /// A new vertex, absorbed until more is known.
  WalkVertex& add();

  From from_;
  Ray first_ray_{};
  bool goes_on_ = false;
  size_t size_ = 0;
  std::vector<WalkVertex> vertices_;  ///< The first size_ are in use.
};

/// Samples a direction at x, the vertex of a walk at this place, and returns the density of the
/// direction to the previous vertex, in projected solid angle, for a walk from the other end;
/// nullopt if the walk ends there.
std::optional<double> scatter(const Walker& walker, const PathRules& rules, Subpath::From from,
                              const StepNumbers& u, int place, WalkVertex& x);

/// Samples a subpath from a random point of a light.
template <class Sampler>
void walk_from_light(const Walker& walker, const PathRules& rules, const WalkLength& most,
                     Sampler& sampler, Subpath& subpath) {
  subpath.clear();
  sampler.begin(Stream::light);
  const LightNumbers u = LightNumbers::draw(sampler);
  const LightSample light =
      sample_light_position(walker.scene, {u.choice, u.position}, walker.time, walker.wavelength);
  if (!(light.x0.pdf > 0)) return;
  const Vertex x0 = light_vertex(*light.emitter, light.x0.at);
  subpath.start(x0, light.x0.pdf);
  const Departure first = walker.emitted_ray(x0, u.direction);
  if (first.pdf > 0) subpath.walk(walker, rules, first, most, sampler);
}

/// The probability of what a walk from the other end flies from x to the vertex before it, which
/// passes_back does not have; changes the likelihood of that walk.
inline double fly_back(const Scene& scene, const WalkVertex& x, Spectrum& likelihood) {
  if (!scene.has_coloured_media()) return 1;
  const Arrival arrival = x.back.after(likelihood);
  likelihood = arrival.next_likelihood();
  return arrival.flown();
}

}  // namespace mlt
