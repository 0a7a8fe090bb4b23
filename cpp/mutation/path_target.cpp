#include "mutation/path_target.h"

#include "mutation/path_seeds.h"
#include "path/refracted_light.h"

namespace mlt {

void PathTarget::evaluate(int first, int last, PathState& x) const {
  update_terms(*scene_, x.path, term_settings(), first, last, x.terms);
  evaluate_target(x);
}

void PathTarget::evaluate(PathState& x) const {
  x.path.set_time(x.path.time);
  x.path.set_wavelength(x.path.wavelength);
  for (Vertex& vertex : x.path.vertices)
    if (vertex.kind == VertexKind::inner)
      vertex.at.lambertian = scene_->bsdf(vertex.at).lambertian(vertex.at);
  compute_terms(*scene_, x.path, term_settings(), x.terms);
  evaluate_target(x);
}

void PathTarget::evaluate_target(PathState& x) const {
  x.target = 0;
  x.choice.known = false;
  x.known.invalidate();
  if (!rules_.wants(x.edges())) return;
  if (x.edges() == 1 && scene_->camera().delta_position() && !x.terms.light_can_be_hit) return;
  const Color f = relative_contribution(x.terms);
  const double target = target_luminance(f);
  if (!(target > 0)) {
    if (std::isnan(target)) x.target = target;
    return;
  }
  if (!x.terms.raster) return;
  x.raster = *x.terms.raster;
  x.rgb = f;
  x.target = of(f, x.raster, certainty(x.terms));
  if (path_factor_ && x.target > 0) x.target *= path_factor_(x);
  if (weights_.threshold() > 0 && x.target > 0) {
    const double tau = x.target / density(x);
    x.known.over_density.set(tau);
    x.target *= weights_.of_chain(tau);
  }
}

ExtraTechnique PathTarget::extra_technique(const PathState& x) const {
  const ExtraTechnique refracted = refracted_technique(x);
  if (refracted.count > 0 || !manifold_) return refracted;
  return manifold_->technique(x.path, x.terms);
}

ExtraTechnique PathTarget::refracted_technique(const PathState& x) const {
  if (!rules_.through_boundaries || !scene_->has_rough_boundaries()) return {};
  RayCounts rays;
  const Walker walker{*scene_, x.path.time, rays};
  return mlt::refracted_technique(walker, x.path, x.terms);
}

PathSeeds PathTarget::seeds() const {
  BidirectionalSettings settings = PathSeeds::settings(*this);
  settings.heuristic = Heuristic::power;  // has a little less noise
  return {*this, settings};
}

}  // namespace mlt
