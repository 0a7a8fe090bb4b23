// The steps of a walk along a light path: emit from a light or the lens, intersect, scatter, and
// connect two vertices. The caller draws the random numbers, and computes the weights.
// BasicPathWave and SubpathWave take the same steps of many walks side by side.
#pragma once

#include "path/ray_counts.h"
#include "path/sample_layout.h"
#include "path/stretch.h"
#include "path/vertex.h"

#include <optional>

namespace mlt {

/// A position on a light, as the end of a path.
struct LightSample {
  const Emitter* emitter;
  PositionSample x0;                 ///< Its density includes the choice of the light. 0: failed.
  std::optional<Spectrum> radiance;  ///< At infinity, if it was sampled together with others.

  /// The radiance in the direction w.
  Spectrum emitted(const Vec3& w) const { return radiance ? *radiance : emitter->eval(x0.at, w); }
};

/// A light and a position on it as the end of a path; the third number of positions in a volume is
/// what is left of that which chose the light.
template <class OnSurface>
LightSample sample_light(const Scene& scene, const EmitterChoice& choice, const Vec2& u,
                         double time, double wavelength, OnSurface&& sample) {
  const Emitter& emitter = *choice.emitter;
  const bool in_volume = scene.has_media() && emitter.glowing();
  LightSample light{
      &emitter, in_volume ? emitter.sample_volume(u, choice.remainder, time) : sample(emitter), {}};
  light.x0.at.time = time;
  light.x0.at.wavelength = wavelength;
  light.x0.pdf *= choice.probability;
  if (scene.has_media()) scene.find_medium_at_light(emitter, light.x0);
  return light;
}

/// Samples the start of a walk from this light.
inline LightSample sample_light_position(const Scene& scene, const EmitterChoice& choice,
                                         const Vec2& u, double time, double wavelength) {
  return sample_light(scene, choice, u, time, wavelength,
                      [&](const Emitter& light) { return light.sample_position(u, time); });
}
/// Samples the start of a walk: the light by u.x, the position on it by (u.y, u.z).
inline LightSample sample_light_position(const Scene& scene, Vec3 u, double time,
                                         double wavelength) {
  const EmitterChoice choice = scene.choose_emitter(u.x);
  return sample_light_position(scene, choice, {u.y, u.z}, time, wavelength);
}
/// Samples a position on this light for next-event estimation at the point `from`, at its time.
inline LightSample sample_direct_position(const Scene& scene, const Vec3& from, double time,
                                          double wavelength, const EmitterChoice& choice,
                                          const Vec2& u) {
  if (!(choice.probability > 0)) return {choice.emitter, {}, {}};
  return sample_light(scene, choice, u, time, wavelength,
                      [&](const Emitter& light) { return light.sample_direct(from, u, time); });
}
inline LightSample sample_direct_position(const Scene& scene, const SurfacePoint& from,
                                          const EmitterChoice& choice, const Vec2& u) {
  return sample_direct_position(scene, from.p, from.time, from.wavelength, choice, u);
}

/// Samples next-event estimation: the light by u.x, the position on it by (u.y, u.z).
inline LightSample sample_direct_position(const Scene& scene, const SurfacePoint& from, Vec3 u) {
  const EmitterChoice choice = scene.choose_emitter_for(from.p, u.x);
  return sample_direct_position(scene, from, choice, {u.y, u.z});
}

/// The first ray of a walk.
struct Departure {
  Ray ray;
  double pdf;  ///< Coefficient in projected solid angle; 0: failed.
};

/// The ray from a point on the lens, at its time, through a raster position.
inline Ray camera_ray(const Camera& camera, const SurfacePoint& xk, const Vec2& raster) {
  const Vec3 w = camera.direction(xk, raster);
  Ray ray{camera.entrance(xk, w), w, xk.time, camera.reach(xk, w), camera.surroundings()};
  ray.wavelength = xk.wavelength;
  return ray;
}

struct CameraRay {
  PositionSample lens;
  Ray ray;
};

/// Samples a point on the lens, a time and a wavelength.
template <class Sampler>
PositionSample sample_lens(const Camera& camera, Sampler& sampler) {
  const LensNumbers u = LensNumbers::draw(sampler);
  PositionSample lens = camera.sample_position(u.position, camera.time(u.time));
  lens.at.wavelength = camera.wavelength([&] { return sampler.next(); });
  return lens;
}
/// Samples these, and makes the ray through a raster position.
template <class Sampler>
CameraRay camera_ray(const Camera& camera, const Vec2& raster, Sampler& sampler) {
  const PositionSample lens = sample_lens(camera, sampler);
  return {lens, camera_ray(camera, lens.at, raster)};
}

/// Takes the other steps of walks at one time, and counts their rays.
struct Walker {
  const Scene& scene;
  double time;
  RayCounts& rays;
  double wavelength = rgb_lanes;  ///< For walks from lights; others have that of their start.

  Departure emitted_ray(const Vertex& x0, const Vec2& u) const;

  /// The ray from a vertex along w.
  Ray leave(const SurfacePoint& at, const Vec3& w) const { return scene.spawn(at, w, time); }

  /// Samples a direction (BsdfAt::sample) and returns the scattered ray; x records the lobe.
  std::optional<Ray> scatter(Vertex& x, const Vec3& towards_previous, const Vec3& u) const;

  /// Finds the nearest surface along the ray; false if there is none.
  bool intersect(const Ray& ray, SurfacePoint& at) const {
    rays.count_intersect();
    return scene.intersect(ray, at);
  }

  /// The number of a leg, a ray up to the next vertex, which decides what is passed on the way.
  template <class Sampler>
  double draw_leg(Sampler& sampler) const {
    return scene.has_passages() ? sampler.next() : 0;
  }
  /// Follows a leg to where it stops, on a surface or in a medium; false if it leaves the scene.
  /// With u_leg = 0 all is passed through which light goes.
  bool arrive(const Ray& ray, double u_leg, SurfacePoint& at) const {
    Passage leg;
    return arrive(ray, u_leg, at, leg);
  }
  /// As above, with what has been passed.
  bool arrive(const Ray& ray, double u_leg, SurfacePoint& at, Passage& leg) const {
    const bool hit = intersect(ray, at);
    return scene.has_passages() ? go_on(ray, u_leg, hit, at, leg) : hit;
  }
  bool arrive(const Ray& ray, double u_leg, Vertex& next) const;
  /// As above, with the likelihood (see Passage) with which the leg begins, and then ends.
  bool arrive(const Ray& ray, double u_leg, SurfacePoint& at, Spectrum& likelihood) const;
  /// Follows a leg through all media, to the surface where it stops or, if it is not infinite, to a
  /// distance in a medium; false if it does not come so far, or leaves the scene.
  bool arrive_at(double distance, const Ray& ray, double u_leg, SurfacePoint& at) const;

  /// Follows a leg on, knowing whether it has hit a surface, and the first that it has.
  bool go_on(const Ray& ray, double u_leg, bool hit, SurfacePoint& at, Passage& leg) const {
    Stretch first;
    return go_on(ray, u_leg, hit, at, leg, first);
  }
  /// As above; finds the first stretch in a medium, too.
  bool go_on(Ray ray, double u_leg, bool hit, SurfacePoint& at, Passage& leg, Stretch& first) const;

  /// Follows a leg to a light: one on the surface where it stops, or background() if there is none.
  template <class Background>
  bool arrive_at_light(const Ray& ray, double u_leg, Spectrum& likelihood, Background&& background,
                       Vertex& x0) const {
    SurfacePoint at;
    return find_light(ray, arrive(ray, u_leg, at, likelihood), at, background, x0);
  }
  /// Finds a light as arrive_at_light() does, after the leg has been followed.
  template <class Background>
  bool find_light(const Ray& ray, bool hit, const SurfacePoint& at, Background&& background,
                  Vertex& x0) const {
    const Emitter* emitter = hit ? scene.emitter(at) : background();
    if (!emitter || emitter->delta_direction()) return false;
    x0 = light_vertex(*emitter, hit ? at : Scene::point_at_infinity(ray));
    return true;
  }

  /// Intersects the ray with the lens, unless a surface blocks it before.
  bool arrive_at_lens(const Ray& ray, Vertex& xk) const;

  /// The light that goes straight from a to b.
  Passage passage(const SurfacePoint& a, const SurfacePoint& b) const {
    rays.count_occluded();
    if (scene.has_passages()) return scene.passage(a, b, time);
    return scene.visible(a, b, time) ? Passage() : Passage::blocked();
  }
  /// Whether any does; without a colour, since most mutations ask for it.
  bool sees(const SurfacePoint& a, const SurfacePoint& b) const {
    rays.count_occluded();
    return scene.has_passages() ? !scene.passage(a, b, time).is_blocked()
                                : scene.visible(a, b, time);
  }

 private:
  /// Goes on behind a surface; false if the leg stops there.
  bool pass(Ray& ray, double& u_leg, bool& hit, SurfacePoint& at, Passage& leg) const;
};

}  // namespace mlt
