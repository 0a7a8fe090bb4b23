#include "wave/lambertian_vertices.h"

#include "base/whole_vectors.h"
#include "scene/scene.h"

namespace mlt {
namespace {

constexpr auto pi_f = static_cast<float>(pi);
constexpr auto ray_offset = static_cast<float>(Scene::ray_offset);

/// See sample_cosine_hemisphere; without branches.
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

/// Equivalent to Frame::around(n).to_world(v).
Vec3f to_world(const Vec3f& n, const Vec3f& v) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  const Vec3f s(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), t(b, sign + n.y * n.y * a, -n.y);
  return s * v.x + t * v.y + n * v.z;
}

}  // namespace

SurfacePoint LambertianVertices::point(int i, uint32_t shape, double time) const {
  SurfacePoint at;
  at.p = Vec3(p[i]);
  at.ng = normalize(Vec3(surface.ng[i]));
  at.shading = Frame::around(normalize(Vec3(n[i])));
  at.shape = shape;
  at.time = time;
  at.extent = surface.extent[i];
  at.lambertian = {*f[i], back[i] > 0 ? Lambertian::Sides::both : Lambertian::Sides::front};
  return at;
}

void LambertianVertices::find_points(int count, const float* d_x, const float* d_y,
                                     const float* d_z, bool strict_normals) {
  const int end = whole_vectors(count);
  for (int i = 0; i < end; ++i) {
    const Vec3f m = n[i], unit = m * (1 / std::sqrt(dot(m, m))), ng = surface.ng[i];
    const Vec3f wc(-d_x[i], -d_y[i], -d_z[i]);
    p.set(i, surface.position(i));
    n.set(i, unit);
    wc_.set(i, wc);
    surface.ng.set(i, ng * std::copysign(1.0f, dot(ng, unit)));
    sides[i] = consistent_sides(ng, unit, wc, strict_normals) ? 1 : 0;
  }
}

/// See direct_light() of path_tracer.h.
void LambertianVertices::unshadowed_lights(int count, bool strict_normals, Heuristic heuristic) {
  const bool balance = heuristic == Heuristic::balance;
  const int end = whole_vectors(count);
  for (int i = 0; i < end; ++i) {
    const Vec3f y = light.position(i), ny = light.ng[i], ng = surface.ng[i];
    const Vec3f to_light = y - p[i];
    const float distance2 = dot(to_light, to_light);
    const Vec3f wl = to_light * (1 / std::sqrt(distance2));
    const float cos_l = dot(wl, n[i]), cos_c = dot(wc_[i], n[i]), cos_y = -dot(wl, ny);
    const bool lit = (light_pdf[i] > 0) & (cos_y > 0) & (cos_l * cos_c > 0) &
                     ((cos_c > 0) | (back[i] > 0)) & (sides[i] > 0) &
                     consistent_sides(ng, n[i], wl, strict_normals);
    const float pdf = light_pdf[i] * distance2 / cos_y;
    const float abs_cos = std::fabs(cos_l);
    const float quotient = abs_cos * (1 / pi_f) / pdf;
    const float weight = abs_cos / (pdf * (1 + quotient * (balance ? 1 : quotient)));
    light_weight[i] = lit ? weight : 0;
    const Vec3f start = departure(p[i], ng, to_light, surface.extent[i]);
    const Vec3f between = departure(y, ny, -to_light, light.extent[i]) - start;
    const float length = std::sqrt(dot(between, between));
    shadow_o.set(i, start);
    shadow_w.set(i, between * (1 / length));
    shadow_length[i] = length * (1 - ray_offset);
  }
}

/// See scatter_to_light() of path_tracer.h: with a density in proportion to the cosine, the weight
/// is pi f.
void LambertianVertices::sample_directions(int count, bool strict_normals) {
  const int end = whole_vectors(count);
  for (int i = 0; i < end; ++i) {
    const float cos_c = dot(wc_[i], n[i]);
    Vec3f to = cosine_hemisphere(static_cast<float>(u_x[i]), static_cast<float>(u_y[i]));
    const float pdf = to.z * (1 / pi_f);
    to.z = std::copysign(to.z, cos_c);
    const Vec3f direction = to_world(n[i], to), ng = surface.ng[i];
    const bool ok = ((cos_c > 0) | ((back[i] > 0) & (cos_c < 0))) & (sides[i] > 0) &
                    consistent_sides(ng, n[i], direction, strict_normals);
    scatter_pdf[i] = ok ? pdf : 0;
    o.set(i, departure(p[i], ng, direction, surface.extent[i]));
    w.set(i, direction);
  }
}

}  // namespace mlt
