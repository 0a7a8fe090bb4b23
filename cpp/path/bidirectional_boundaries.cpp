// The technique of BidirectionalSampler for light that enters a medium through a rough boundary
// (refracted_light.h).
#include "path/bidirectional_sampler.h"

namespace mlt {

/// The density of the technique over that with which another one makes x_0 and x_1.
double BidirectionalSampler::refracted_over(double density, const Vertex& x0, const Vertex& x1,
                                            const Vertex& x2, RayCounts& rays) const {
  if (!refracts_ || x2.kind != VertexKind::inner) return 0;
  const double refracted = refracted_density(walker(rays), x0, x1, x2);
  return refracted > 0 ? refracted / density : 0;
}

/// As above, where a walk from the camera has hit the light x_0 with its vertex t - 1.
double BidirectionalSampler::refracted_over_hit_light(const Vertex& x0, int t,
                                                      RayCounts& rays) const {
  if (t < 4 || !connectable(camera_[t - 2].vertex)) return 0;
  const WalkVertex &x1 = camera_[t - 2], &x2 = camera_[t - 3];
  return refracted_over(camera_[t - 1].forward * x1.forward, x0, x1.vertex, x2.vertex, rays);
}

/// Light enters on its way to camera vertex t - 1.
bool BidirectionalSampler::evaluate_refracted(Connection& connection, Rng& rng, RayCounts& rays) {
  const SurfacePoint& x = camera_[connection.t - 1].vertex.at;
  if (!x.in_medium() || !choose_direct(connection.t)) return false;
  const Vertex& x0 = direct_.vertex;
  if (!RefractedLight::serves(*scene_->emitters()[x0.emitter])) return false;
  const Walker walker = this->walker(rays);
  RefractedLight refracted(walker, x, x0.at);
  if (!refracted.exists()) return false;
  RandomSampler sampler(rng);
  const auto sampled = refracted.sample(StepNumbers::draw(sampler));
  if (!sampled) return false;

  assembled_.vertices = {x0, inner_vertex(sampled->y), camera_[connection.t - 1].vertex};
  complete_assembled(connection);
  const PathTerms& terms = assembled_terms_;
  const double walked = terms[0].from_light * terms[1].from_light;
  if (!(walked > 0)) return false;
  return evaluate_assembled({2, direct_pdf_ * sampled->pdf * terms[1].G / walked}, connection);
}

}  // namespace mlt
