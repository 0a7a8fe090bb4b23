#include "path/manifold_walk.h"

namespace mlt {

Ray ray_through(const Scene& scene, const SurfacePoint& end, const Vec3& p, double time) {
  if (!end.infinite()) {
    // the ray starts a little off the surface, but has to pass through p
    Ray ray = scene.spawn(end, normalize(p - end.p), time);
    ray.d = normalize(p - ray.o);
    return ray;
  }
  const Bounds& bounds = scene.bounds();
  const double back = dot(bounds.center - p, end.p) + bounds.radius;
  Ray ray{p + back * end.p, -end.p, time, infinity, end.medium};
  ray.wavelength = end.wavelength;
  return ray;
}

bool ManifoldWalk::start(const Scene& scene, const Vertex* first, int count) {
  scene_ = &scene;
  count_ = count;
  if (count_ > most) return false;
  chain_.assign(first, first + count + 2);
  next_.resize(chain_.size());
  for (int i = 0; i < count_; ++i) {
    const auto kept = specular_scattering(scene, chain_[i].at, chain_[i + 1], chain_[i + 2].at);
    if (!kept) return false;
    kept_[i] = *kept;
  }
  return true;
}

bool ManifoldWalk::change_wavelength(double u, double time, RayCounts& rays) {
  for (Vertex& x : chain_) x.at.wavelength = u;
  next_ = chain_;
  if (!trace(chain_[1].at.p, chain_[count_ + 1].at, time, rays, next_)) return false;
  std::swap(chain_, next_);
  return true;
}

bool ManifoldWalk::go(const SurfacePoint& end, double time, RayCounts& rays) {
  /// Distance from the end at which a walk has converged, as an angle seen from the last vertex.
  constexpr double tolerance = 1e-7;
  next_[0] = chain_[0];
  Vec3 move(0);
  double share = 1;
  bool moved = true;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 missing = end.p - chain_[count_ + 1].at.p;
    const double distance = length(missing);
    if (distance <= tolerance * length(end.p - chain_[count_].at.p))
      return Walker{*scene_, time, rays}.sees(chain_[count_].at, end);
    if (moved) {
      const SpecularChain chain(*scene_, chain_.data(), count_);
      if (!(chain.density() > 0)) return false;
      move = chain.first_move(missing);
    }
    moved = trace(chain_[1].at.p + share * move, end, time, rays, next_) &&
            length(end.p - next_[count_ + 1].at.p) < distance;
    if (moved) std::swap(chain_, next_);
    share = moved ? std::min(1.0, 2 * share) : 0.5 * share;
    if (share < least_step) return false;
  }
  return false;
}

bool ManifoldWalk::ended_in(const Vertex* first) const {
  constexpr double tolerance = 1e-3;  // of the shorter edge
  const auto length_of = [&](int i) {
    const SurfacePoint &a = first[i].at, &b = first[i + 1].at;
    return a.infinite() ? infinity : length(b.p - a.p);
  };
  for (int i = 1; i <= count_; ++i) {
    const double edge = std::min(length_of(i - 1), length_of(i));
    if (!(length(chain_[i].at.p - first[i].at.p) < tolerance * edge)) return false;
  }
  return true;
}

bool ManifoldWalk::trace(const Vec3& p, const SurfacePoint& end, double time, RayCounts& rays,
                         Chain& chain) const {
  const Walker walker{*scene_, time, rays};
  Ray ray = ray_through(*scene_, chain_[0].at, p, time);
  for (int i = 1; i <= count_; ++i) {
    if (!walker.arrive(ray, 0, chain[i]) || !has_constraint(*scene_, chain[i])) return false;
    chain[i].lobe = chain_[i].lobe;
    const auto out = scattered_direction(*scene_, chain[i], kept_[i - 1], -ray.d);
    if (!out) return false;
    ray = walker.leave(chain[i].at, *out);
  }
  const double along = dot(end.p - ray.o, ray.d);
  chain[count_ + 1].at.p = ray.o + along * ray.d;
  return along > 0;
}

}  // namespace mlt
