#include "wave/single_vertices.h"

#include "wave/scatter_by_material.h"

namespace mlt {
namespace {

/// The direction to the sampled light in the shading frame; 0 if no light comes from there.
Vec3 local_light(const SingleVertex& vertex, bool strict_normals) {
  if (!vertex.samples_light() || !(vertex.light.x0.pdf > 0)) return Vec3(0);
  const Vec3 wl = direction(vertex.at, vertex.light.x0.at);
  return consistent_sides(vertex.at, wl, strict_normals) ? vertex.at.shading.to_local(wl) : Vec3(0);
}

/// The factor of values in a medium, and the cosine there; on a surface both are 1 and its own.
struct Place {
  Spectrum scattering{1};
  bool in_medium = false;
  double cosine(double z) const { return in_medium ? 1 : z; }
};
Place place_of(const Scene& scene, const SurfacePoint& at) {
  if (!at.in_medium()) return {};
  return {scene.medium(at).at(at.p, at.wavelength).scattering, true};
}

/// The i-th result, of a smooth reflection or in a medium (see scatter_to_light).
std::optional<ScatterSample> scattered(const ScatteringLanes& lanes, int i, const SurfacePoint& at,
                                       const Place& place, bool strict_normals) {
  if (!(lanes.pdf[i] > 0) || is_black(lanes.f[i])) return std::nullopt;
  const Vec3 to(lanes.to[i]), w = normalize(at.shading.to_world(to));
  if (!consistent_sides(at, w, strict_normals)) return std::nullopt;
  const double pdf = lanes.pdf[i];
  const Spectrum weight = place.scattering * lanes.f[i] * (place.cosine(abs_cos_theta(to)) / pdf);
  return ScatterSample{w, weight, pdf, Lobe::smooth, 1, false};
}

}  // namespace

void SingleVertices::scatter_in_lanes(const Scene& scene, bool strict_normals) {
  for (SingleVertex& vertex : *this) {
    const Bsdf* bsdf = vertex.at.lambertian.known() ? nullptr : &scene.bsdf(vertex.at);
    vertex.bsdf = bsdf && bsdf->supports_lanes() ? bsdf : nullptr;
  }
  const auto put = [&](const SingleVertex& vertex, int i) {
    lanes_.at[i] = &vertex.at;
    lanes_.wc.set(i, Vec3f(vertex.at.shading.to_local(vertex.wc)));
    lanes_.wl.set(i, Vec3f(local_light(vertex, strict_normals)));
    lanes_.set_numbers(i, vertex.u_scatter);
  };
  const auto take = [&](SingleVertex& vertex, int i) {
    const Place place = place_of(scene, vertex.at);
    vertex.from_light = {{lanes_.f_light[i] * place.scattering, 0, lanes_.pdf_light[i]},
                         place.cosine(lanes_.wl.z[i]),
                         place.cosine(lanes_.wc.z[i])};
    vertex.scattered = scattered(lanes_, i, vertex.at, place, strict_normals);
  };
  scatter_by_material(begin(), end(), lanes_, put, take);
}

}  // namespace mlt
