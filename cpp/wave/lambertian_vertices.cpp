#include "wave/lambertian_vertices.h"

#include "base/whole_vectors.h"
#include "scene/scene.h"

namespace mlt {

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
void LambertianVertices::unshadowed_lights(int count, bool strict_normals, const MisExponent& mis) {
  const int end = whole_vectors(count);
  for (int i = 0; i < end; ++i) {
    const Vec3f y = light.position(i), ny = light.ng[i], ng = surface.ng[i];
    const Vec3f to_light = y - p[i];
    const float distance2 = dot(to_light, to_light);
    const Vec3f w = to_light * (1 / std::sqrt(distance2));
    const float cos_y = -dot(w, ny), pdf = light_pdf[i] * distance2 / cos_y;
    const bool turned = is_lit_from(i, w, strict_normals);
    const bool lit = (light_pdf[i] > 0) & (cos_y > 0) & turned;
    const float weight = direct_weight(cosine(i, w), pdf, mis);
    light_weight[i] = lit ? weight : 0;
    wl.set(i, w);
    direction_pdf[i] = pdf;
    const Vec3f start = ray_origin(p[i], ng, to_light, surface.extent[i]);
    const Vec3f ray = ray_origin(y, ny, -to_light, light.extent[i]) - start;
    const float length = std::sqrt(dot(ray, ray));
    shadow_o.set(i, start);
    shadow_w.set(i, ray * (1 / length));
    shadow_length[i] = length * float(1 - ray_offset);
  }
}

/// See scatter_to_light() of path_tracer.h: with a density in proportion to the cosine, the weight
/// is pi f.
void LambertianVertices::sample_directions(int count, bool strict_normals) {
  const int end = whole_vectors(count);
  for (int i = 0; i < end; ++i) {
    const float cos_c = dot(wc_[i], n[i]);
    const Vec3f to = sample_lambertian(cos_c, Vec2f(u_x[i], u_y[i]));
    const Vec3f direction = FrameOf<float>::around(n[i]).to_world(to), ng = surface.ng[i];
    const bool scattered = scatters(cos_c, back[i] > 0),
               consistent = consistent_sides(ng, n[i], direction, strict_normals);
    const bool ok = scattered & (sides[i] > 0) & consistent;
    scatter_pdf[i] = ok ? lambertian_pdf(to.z) : 0;
    o.set(i, ray_origin(p[i], ng, direction, surface.extent[i]));
    w.set(i, direction);
  }
}

}  // namespace mlt
