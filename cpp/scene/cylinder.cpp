// In the frame of the cylinder a line passes the axis at the distance |o x d| / |d|, taken in the xy
// plane. Written with it, the discriminant is a product of a sum and a difference of lengths, and
// the product of the roots is another: nothing cancels for lines that start on the surface.
#include "scene/cylinder.h"

#include "math/warp.h"

namespace mlt {

Cylinder::Cylinder(const Vec3& base, const Frame& frame, double radius, double length,
                   bool flip_normals)
    : base_(base), frame_(frame), radius_(radius), length_(length), side_(flip_normals ? -1 : 1) {
  Vec3 low, high;
  bounds(low, high);
  extent_ = max_component(glm::max(glm::abs(low), glm::abs(high)));
}

std::optional<Cylinder::Roots> Cylinder::roots(const Vec3& world_o, const Vec3& world_d) const {
  const Vec3 o = frame_.to_local(world_o - base_), d = frame_.to_local(world_d);
  const double a = d.x * d.x + d.y * d.y;
  if (!(a > 0)) return std::nullopt;
  const double reach = radius_ * std::sqrt(a), pass = std::abs(o.x * d.y - o.y * d.x);
  if (pass > reach) return std::nullopt;
  const double b = -(o.x * d.x + o.y * d.y);
  const double q = b + std::copysign(std::sqrt((reach - pass) * (reach + pass)), b);
  const double distance = std::sqrt(o.x * o.x + o.y * o.y);
  const double one = q / a;
  const double other = q == 0 ? 0 : (distance - radius_) * (distance + radius_) / q;
  const double near = std::min(one, other), far = std::max(one, other);
  const auto counts = [&](double t) {
    const double z = o.z + t * d.z;
    return z >= 0 && z <= length_;
  };
  return Roots{near, far, counts(near), counts(far)};
}

std::optional<double> Cylinder::intersect(const Vec3& o, const Vec3& d, double t_min,
                                          double t_max) const {
  const std::optional<Roots> t = roots(o, d);
  if (!t) return std::nullopt;
  if (t->near_counts && t->near >= t_min && t->near <= t_max) return t->near;
  if (t->far_counts && t->far >= t_min && t->far <= t_max) return t->far;
  return std::nullopt;
}

void Cylinder::surface_point(const Ray& ray, const Hit& hit, SurfacePoint& at) const {
  double t = hit.t;  // Rounded to a float by the accelerator: only good enough to tell the roots.
  if (const std::optional<Roots> exact = roots(ray.o, ray.d)) {
    const bool near = t - exact->near <= exact->far - t + 1e-6 * t;
    t = exact->near_counts && (near || !exact->far_counts) ? exact->near : exact->far;
  }
  const Vec3 q = frame_.to_local(ray.o + ray.d * t - base_);
  fill(normalize(Vec2(q)), std::min(std::max(q.z, 0.0), length_), at);
}

void Cylinder::fill(const Vec2& outward, double z, SurfacePoint& at) const {
  const Vec3 n = frame_.s * outward.x + frame_.t * outward.y;
  at.p = base_ + n * radius_ + frame_.n * z;
  at.ng = n * side_;
  const Vec3 s = frame_.t * outward.x - frame_.s * outward.y;
  at.shading = {s, cross(at.ng, s), at.ng};
  at.uv = {turns(outward.x, outward.y), z / length_};
  at.extent = extent_;
  at.shape = index_;
  at.primitive = 0;
  at.kind = PointKind::surface;
}

PositionSample Cylinder::sample_position(const Vec2& u) const {
  const SinCos phi = sincos_turns(u.y);
  PositionSample sample;
  fill({phi.cos, phi.sin}, u.x * length_, sample.at);
  sample.pdf = 1 / area();
  return sample;
}

Vec2 Cylinder::invert_position(const SurfacePoint& at) const {
  const Vec3 q = frame_.to_local(at.p - base_);
  return {std::min(std::max(q.z / length_, 0.0), 1 - 0x1p-53), turns(q.x, q.y)};
}

void Cylinder::bounds(Vec3& low, Vec3& high) const {
  const Vec3 reach = glm::sqrt(frame_.s * frame_.s + frame_.t * frame_.t) * radius_;
  const Vec3 end = base_ + frame_.n * length_;
  low = glm::min(base_, end) - reach;
  high = glm::max(base_, end) + reach;
}

}  // namespace mlt
