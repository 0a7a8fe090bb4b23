#include "path/matte_vertices.h"

#include "base/whole_vectors.h"
#include "scene/scene.h"

namespace mlt {
namespace {

constexpr auto pi_f = static_cast<float>(pi);
constexpr auto ray_offset = static_cast<float>(Scene::ray_offset);

/// Where a ray along w begins: off its surface.
Vec3f departure(const Vec3f& p, const Vec3f& ng, const Vec3f& w, float extent) {
  return p + ng * std::copysign(ray_offset * extent, dot(ng, w));
}

/// sample_cosine_hemisphere without branches.
Vec3f cosine_hemisphere(float u_x, float u_y) {
  const float a = 2 * u_x - 1, b = 2 * u_y - 1;
  const bool wide = std::fabs(a) > std::fabs(b);
  const float r = wide ? a : b, other = wide ? b : a;
  const float x = (pi_f / 4) * (r == 0 ? 0 : other / r), x2 = x * x;
  // Taylor series, |x| <= pi / 4.
  const float sin = x + x * x2 * (-1.f / 6 + x2 * (1.f / 120 + x2 * (-1.f / 5040)));
  const float cos = 1 + x2 * (-0.5f + x2 * (1.f / 24 + x2 * (-1.f / 720 + x2 * (1.f / 40320))));
  return {r * (wide ? cos : sin), r * (wide ? sin : cos), std::sqrt((1 - r) * (1 + r))};
}

/// Frame::around(n).to_world(v).
Vec3f to_world(const Vec3f& n, const Vec3f& v) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  const Vec3f s(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), t(b, sign + n.y * n.y * a, -n.y);
  return s * v.x + t * v.y + n * v.z;
}

}  // namespace

void MatteVertices::add(int of_walk, uint32_t of_shape, const MeshPoint& point,
                        const Vec3f& towards_camera, const Matte& matte) {
  const int i = count++;
  walk[i] = of_walk;
  shape[i] = of_shape;
  p.set(i, point.p);
  ng.set(i, point.ng);
  n.set(i, point.n);
  wc.set(i, towards_camera);
  extent[i] = point.extent;
  back[i] = matte.sides == Matte::Sides::both ? 1 : 0;
  f[i] = matte.f;
}

void MatteVertices::set_light(int i, const MeshPoint& point, const Color& emitted, double pdf) {
  y.set(i, point.p);
  ny.set(i, point.ng);
  y_extent[i] = point.extent;
  radiance[i] = emitted;
  light_pdf[i] = static_cast<float>(pdf);
}

SurfacePoint MatteVertices::point(int i, double time) const {
  SurfacePoint at;
  at.p = Vec3(p[i]);
  at.ng = normalize(Vec3(ng[i]));
  at.shading = Frame::around(normalize(Vec3(n[i])));
  at.shape = shape[i];
  at.time = time;
  at.extent = extent[i];
  at.matte = {f[i], back[i] > 0 ? Matte::Sides::both : Matte::Sides::front};
  return at;
}

/// direct_light() of path_tracer.h.
void MatteVertices::unshadowed_lights(bool strict_normals, Heuristic heuristic) {
  const bool balance = heuristic == Heuristic::balance;
  const int end = whole_vectors(count);
  for (int i = 0; i < end; ++i) {
    const Vec3f to_light = y[i] - p[i];
    const float distance2 = dot(to_light, to_light);
    const Vec3f wl = to_light * (1 / std::sqrt(distance2));
    const float cos_l = dot(wl, n[i]), cos_c = dot(wc[i], n[i]), cos_y = -dot(wl, ny[i]);
    const bool lit = (light_pdf[i] > 0) & (cos_y > 0) & (cos_l * cos_c > 0) &
                     ((cos_c > 0) | (back[i] > 0)) &
                     consistent_sides(ng[i], n[i], wl, strict_normals);
    const float pdf = light_pdf[i] * distance2 / cos_y;
    const float abs_cos = std::fabs(cos_l);
    const float quotient = abs_cos * (1 / pi_f) / pdf;
    const float weight = abs_cos / (pdf * (1 + quotient * (balance ? 1 : quotient)));
    light_weight[i] = lit ? weight : 0;
    const Vec3f start = departure(p[i], ng[i], to_light, extent[i]);
    const Vec3f between = departure(y[i], ny[i], -to_light, y_extent[i]) - start;
    const float length = std::sqrt(dot(between, between));
    shadow_o.set(i, start);
    shadow_w.set(i, between * (1 / length));
    shadow_length[i] = length * (1 - ray_offset);
  }
}

/// scatter_to_light() of path_tracer.h: with a density in proportion to the cosine, the weight is
/// pi f.
void MatteVertices::sample_directions(bool strict_normals) {
  const int end = whole_vectors(count);
  for (int i = 0; i < end; ++i) {
    const float cos_c = dot(wc[i], n[i]);
    Vec3f to = cosine_hemisphere(u_x[i], u_y[i]);
    const float pdf = to.z * (1 / pi_f);
    to.z = std::copysign(to.z, cos_c);
    const Vec3f direction = to_world(n[i], to);
    const bool ok = ((cos_c > 0) | ((back[i] > 0) & (cos_c < 0))) &
                    consistent_sides(ng[i], n[i], direction, strict_normals);
    scatter_pdf[i] = ok ? pdf : 0;
    o.set(i, departure(p[i], ng[i], direction, extent[i]));
    w.set(i, direction);
  }
}

}  // namespace mlt
