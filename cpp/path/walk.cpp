#include "path/walk.h"

namespace mlt {

Departure Walker::emitted_ray(const Vertex& x0, const Vec2& u) const {
  const RaySample sample = scene.emitters()[x0.emitter]->sample_ray(x0.at, u);
  if (!(sample.pdf > 0)) return {{}, 0};
  if (!x0.at.infinite()) return {leave(x0.at, sample.direction), sample.pdf};
  Ray ray{sample.origin, sample.direction, time, infinity, x0.at.medium};
  ray.wavelength = x0.at.wavelength;
  return {ray, sample.pdf};
}

std::optional<Ray> Walker::scatter(Vertex& x, const Vec3& towards_previous, const Vec3& u) const {
  const auto sample = BsdfAt(scene, x.at).sample(towards_previous, u);
  if (!sample) return std::nullopt;
  x.lobe = sample->lobe;
  return leave(x.at, sample->w);
}

bool Walker::arrive(const Ray& ray, double u_leg, Vertex& next) const {
  next = {};
  return arrive(ray, u_leg, next.at);
}

bool Walker::arrive(const Ray& ray, double u_leg, SurfacePoint& at, Spectrum& likelihood) const {
  Passage leg;
  leg.likelihood = likelihood;
  const bool hit = arrive(ray, u_leg, at, leg);
  if (hit && scene.has_coloured_media())
    likelihood = scene.arrival(leg, at, ray.d).next_likelihood();
  return hit;
}

bool Walker::go_on(Ray ray, double u_leg, bool hit, SurfacePoint& at, Passage& leg,
                   Stretch& first) const {
  for (;;) {
    if (ray.medium != no_medium) {
      const double distance = hit ? distance_to(at.p, ray) : ray.t_max;
      if (const auto stop = fly(scene.media()[ray.medium], ray, distance, u_leg, leg, first)) {
        at = Scene::medium_point(ray, *stop);
        return true;
      }
    }
    if (!hit) return false;
    if (!pass(ray, u_leg, hit, at, leg)) return true;
  }
}

bool Walker::pass(Ray& ray, double& u_leg, bool& hit, SurfacePoint& at, Passage& leg) const {
  const Passage here = scene.passage(at, ray.d);
  if (!(u_leg < here.probability)) return false;
  u_leg /= here.probability;
  leg *= here;
  ray = scene.beyond(ray, at);
  hit = intersect(ray, at);
  return true;
}

bool Walker::arrive_at(double distance, const Ray& first, double u_leg, SurfacePoint& at) const {
  Ray ray = first;
  Passage leg;
  bool hit = intersect(ray, at);
  for (;;) {
    const double segment = hit ? distance_to(at.p, ray) : ray.t_max;
    if (distance < segment) {
      if (ray.medium == no_medium || !scene.media()[ray.medium].stops_walks()) return false;
      at = Scene::medium_point(ray, distance);
      return true;
    }
    distance -= segment;
    if (!hit) return false;
    if (!pass(ray, u_leg, hit, at, leg)) return !std::isfinite(distance);
  }
}

bool Walker::arrive_at_lens(const Ray& ray, Vertex& xk) const {
  const auto lens = scene.camera().hit_lens(ray);
  if (!lens) return false;
  xk = camera_vertex(*lens);
  xk.at.wavelength = ray.wavelength;
  SurfacePoint start;
  start.p = ray.o;
  start.kind = PointKind::isolated;
  return sees(start, *lens);
}

}  // namespace mlt
