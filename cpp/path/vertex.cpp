#include "path/vertex.h"

namespace mlt {

VertexTerms delta_terms(const Scene& scene, const SurfacePoint& at, Lobe lobe, const Vec3& wl,
                        const Vec3& wc) {
  const BsdfAt bsdf(scene, at);
  const WorldScattering s = bsdf.scattering(wl, wc, lobe);
  const double geometric_l = std::abs(dot(at.ng, wl)), geometric_c = std::abs(dot(at.ng, wc));
  const double adjoint = std::abs(s.cos_l) * geometric_c / (std::abs(s.cos_c) * geometric_l);
  const double eta2 =
      lobe == Lobe::transmission ? sqr(bsdf.relative_eta(at.shading.to_local(wl))) : 1.0;
  return {s.f * adjoint, s.pdf_from_light, s.pdf_from_camera * eta2 * adjoint, s.disperses};
}

VertexTerms end_terms(const Scene& scene, const Vertex& x, const Vec3& wl, const Vec3& wc) {
  if (x.kind == VertexKind::camera) return lens_terms(scene, x.at, wl).vertex;
  const Emitter& emitter = *scene.emitters()[x.emitter];
  return {emitter.eval(x.at, wc), emitter.pdf_ray(x.at, wc), 0};
}

LensTerms lens_terms(const Scene& scene, const SurfacePoint& xk, const Vec3& wl) {
  const auto projection = scene.camera().project(xk, wl);
  if (!projection) return {};
  return {{Spectrum(projection->importance), 0, projection->pdf_direction}, projection->raster};
}

double light_position_pdf(const Scene& scene, const Vertex& x0) {
  return scene.emitter_probability(x0.emitter) * scene.emitters()[x0.emitter]->pdf_position(x0.at);
}

double direct_position_pdf(const Scene& scene, const Vertex& x0, const SurfacePoint& from) {
  return scene.emitter_probability_for(x0.emitter, from.p) *
         scene.emitters()[x0.emitter]->pdf_direct(from.p, x0.at);
}

double camera_position_pdf(const Scene& scene, const Vertex& xk) {
  return scene.camera().pdf_position(xk.at);
}

bool can_be_hit(const Scene& scene, const Vertex& end) {
  return end.kind == VertexKind::light ? !end.delta() && !scene.emitters()[end.emitter]->delta()
                                       : scene.camera().can_be_hit();
}

}  // namespace mlt
