#include "path/specular_constraint.h"

#include "path/half_vector.h"
#include "scene/shape/normal_gradient.h"

namespace mlt {
namespace {

/// The sum eta wl + wc, and its terms.
struct Sum {
  Vec3 wl, wc, value;
  double eta;
  bool reflected;
};

Sum sum_at(const Scene& scene, const SurfacePoint& before, const Vertex& own,
           const SurfacePoint& after) {
  Sum sum;
  sum.wl = direction(own.at, before);
  sum.wc = direction(own.at, after);
  const Vec3 l = own.at.shading.to_local(sum.wl), c = own.at.shading.to_local(sum.wc);
  sum.reflected = own.delta() ? own.lobe == Lobe::reflection : same_side(l, c);
  sum.eta = sum.reflected ? 1 : scene.bsdf(own.at).relative_eta(own.at, l);
  sum.value = sum.eta * sum.wl + sum.wc;
  return sum;
}

/// d w / d p of the direction w to a point p, times the row `v`.
Vec3 by_end(const SurfacePoint& at, const SurfacePoint& end, const Vec3& w, const Vec3& v) {
  if (end.infinite()) return Vec3(0);
  return (v - w * dot(v, w)) / length(end.p - at.p);
}

/// The derivative of v . (s, t) by the normal from which Frame::around makes s and t.
PlaneByPoint by_normal(const Vec3& n, const Vec3& v) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z);
  const double x = n.x, y = n.y;
  return {{sign * (2 * a * x * v.x + a * y * v.y - v.z), sign * a * x * v.y,
           sign * sqr(a) * x * (x * v.x + y * v.y)},
          {a * y * v.x, a * x * v.x + 2 * a * y * v.y - v.z, sqr(a) * y * (x * v.x + y * v.y)}};
}

}  // namespace

std::optional<SpecularConstraint> specular_constraint(const Scene& scene,
                                                      const SurfacePoint& before, const Vertex& own,
                                                      const SurfacePoint& after) {
  const Sum sum = sum_at(scene, before, own, after);
  const Frame frame = Frame::around(own.at.shading.n);
  Vec3 rows[2] = {frame.s, frame.t};
  Vec3 v = sum.value;
  SpecularConstraint c;
  if (own.delta()) {
    c.per_direction = std::abs(dot(sum.wc, frame.n)) / abs_cos(own.at, sum.wc);
  } else {
    const double l = length(v) * std::copysign(1.0, dot(v, frame.n));
    if (!(std::abs(l) > 1e-6)) return std::nullopt;
    v /= l;
    for (Vec3& row : rows) row = (row - v * dot(v, row)) / l;
  }
  c.g = {dot(v, frame.s), dot(v, frame.t)};
  const auto by_ends = [&](const SurfacePoint& end, const Vec3& w, double factor) {
    return PlaneByPoint{factor * by_end(own.at, end, w, rows[0]),
                        factor * by_end(own.at, end, w, rows[1])};
  };
  c.before = by_ends(before, sum.wl, sum.eta);
  c.after = by_ends(after, sum.wc, 1);
  const PlaneByPoint turned = by_normal(frame.n, v);
  const Mat3 gradient = normal_gradient(scene, own.at);
  c.own = {turned.s * gradient - c.before.s - c.after.s,
           turned.t * gradient - c.before.t - c.after.t};
  return c;
}

std::optional<SpecularScattering> specular_scattering(const Scene& scene,
                                                      const SurfacePoint& before, const Vertex& own,
                                                      const SurfacePoint& after) {
  const Sum sum = sum_at(scene, before, own, after);
  const Frame frame = Frame::around(own.at.shading.n);
  SpecularScattering s{own.delta(), sum.reflected, dot(sum.wl, frame.n) > 0, {}};
  if (s.delta) return s;
  const double l = length(sum.value) * std::copysign(1.0, dot(sum.value, frame.n));
  if (!(std::abs(l) > 1e-6)) return std::nullopt;
  s.g = {dot(sum.value, frame.s) / l, dot(sum.value, frame.t) / l};
  return s;
}

std::optional<Vec3> scattered_direction(const Scene& scene, const Vertex& own,
                                        const SpecularScattering& s, const Vec3& wl) {
  const SurfacePoint& at = own.at;
  const Frame frame = Frame::around(at.shading.n);
  const Vec3 in = frame.to_local(wl);
  if (!s.delta && (in.z > 0) != s.front) return std::nullopt;
  const Vec3 h(s.g, safe_sqrt(1 - glm::dot(s.g, s.g)));
  const auto out =
      s.reflected ? reflect_about(in, h)
                  : refract_about(in, h, scene.bsdf(at).relative_eta(at, at.shading.to_local(wl)));
  if (!out) return std::nullopt;
  return frame.to_world(*out);
}

}  // namespace mlt
