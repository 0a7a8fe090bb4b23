#include "path/walk.h"

namespace mlt {

Departure Walker::leave_light(const Vertex& x0, const Vec2& u) const {
  const RaySample sample = scene.emitters()[x0.emitter]->sample_ray(x0.at, u);
  if (!(sample.pdf > 0)) return {{}, 0};
  return {x0.at.infinite() ? Ray{sample.origin, sample.direction, time}
                           : leave(x0.at, sample.direction),
          sample.pdf};
}

std::optional<Ray> Walker::scatter(Vertex& x, const Vec3& towards_previous, const Vec3& u) const {
  const auto sample = BsdfAt(scene, x.at).sample(towards_previous, u);
  if (!sample) return std::nullopt;
  x.lobe = sample->lobe;
  return leave(x.at, sample->w);
}

bool Walker::arrive(const Ray& ray, Vertex& next) const {
  next = {};
  return arrive(ray, next.at);
}

bool Walker::arrive_at_lens(const Ray& ray, Vertex& xk) const {
  const auto lens = scene.camera().hit_lens(ray);
  if (!lens) return false;
  xk = camera_vertex(*lens);
  SurfacePoint at;
  return !arrive(ray, at) || length_squared(at.p - ray.o) > length_squared(lens->p - ray.o);
}

}  // namespace mlt
