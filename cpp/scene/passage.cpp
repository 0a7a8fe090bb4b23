// What light passes on its way through the scene.
#include "scene/scene.h"

namespace mlt {

Passage Scene::passage(const SurfacePoint& at, const Vec3& w) const {
  const Bsdf& surface = bsdf(at);
  if (!surface.has_passage()) return Passage::blocked();
  Passage passage = surface.passage(at, at.shading.to_local(w));
  const Emitter* light = emitter(at);
  if (light && !light->delta_direction()) passage.probability = std::min(passage.probability, 0.5);
  return passage;
}

Passage Scene::passage(Ray& ray) const {
  const Occlusion found = accel_->occluded(ray);
  if (found.blocked) return Passage::blocked();
  return found.passed ? pass_surfaces(ray) : Passage();
}

Passage Scene::pass_surfaces(Ray& ray) const {
  Passage all;
  SurfacePoint at;
  while (!all.is_blocked() && ray.t_max > 0 && intersect(ray, at)) {
    if (ray.medium != no_medium) fly(media_[ray.medium], ray, distance_to(at.p, ray), all);
    all *= passage(at, ray.d);
    ray = beyond(ray, at);
  }
  return all;
}

Passage Scene::pass(Ray& ray, bool surfaces) const {
  Passage all = surfaces ? pass_surfaces(ray) : Passage();
  if (ray.medium != no_medium) fly(media_[ray.medium], ray, ray.before + ray.t_max, all);
  return all;
}

Passage Scene::passage(const SurfacePoint& a, const SurfacePoint& b, double time) const {
  const std::optional<Ray> between = segment(a, b, time);
  if (!between) return Passage::blocked();
  Ray ray = *between;
  const bool ends = !a.infinite() && !b.infinite();
  if (has_media_ && ends) enter_medium(a, ray);  // spawn() has done it for the others
  Passage all = passage(ray);
  if (all.is_blocked() || ray.medium == no_medium) return all;
  fly(media_[ray.medium], ray, ends ? distance_to(edge_end(b, -ray.d), ray) : ray.t_max, all);
  return all;
}

}  // namespace mlt
