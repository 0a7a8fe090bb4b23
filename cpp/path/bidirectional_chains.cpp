// The technique of BidirectionalSampler that joins a light across a chain of delta vertices.
#include "path/bidirectional_sampler.h"

namespace mlt {

/// How often the technique counts (see ManifoldSampler) that joins the light to `end` across the
/// chain of vertices 1 ... m of the light walk.
double BidirectionalSampler::manifold_count(int m, const Vertex& end) const {
  if (!manifold_ || m < 1) return 0;
  chain_.assign(1, light_[0].vertex);
  double walk = 1, lobes = 1;
  for (int i = 1; i <= m; ++i) {
    if (connectable(light_[i].vertex)) return 0;
    chain_.push_back(light_[i].vertex);
    walk *= light_[i].forward;
    lobes *= light_[i].next_coefficient;
  }
  chain_.push_back(end);
  return manifold_->chain_density(chain_.data(), m, lobes) / walk;
}

/// The density of the technique that joins the light across a chain, over that of hitting the light
/// with camera vertex t - 1.
double BidirectionalSampler::manifold_over_hit_light(const Vertex& x0, double from_light,
                                                     int t) const {
  if (!manifold_) return 0;
  chain_.assign(1, x0);
  double walk = camera_[t - 1].forward, lobes = 1;
  int i = t - 2;
  for (; !connectable(camera_[i].vertex); --i) {
    chain_.push_back(camera_[i].vertex);
    walk *= camera_[i].forward;
    lobes *= camera_[i - 1].reverse / camera_[i].density_back(1);
  }
  const int m = t - 2 - i;
  chain_.push_back(camera_[i].vertex);
  return m == 0 ? 0 : from_light * manifold_->chain_density(chain_.data(), m, lobes) / walk;
}

/// The light is joined to camera vertex t - 1 across a chain.
bool BidirectionalSampler::evaluate_manifold(Connection& connection, Rng& rng, RayCounts& rays) {
  const int t = connection.t;
  const WalkVertex& y = camera_[t - 1];
  if (y.vertex.at.infinite()) return false;
  if (t > 1 && !scene_->bsdf(y.vertex.at).has_smooth()) return false;
  if (!manifold_->find(light_[0].vertex, y.vertex, time_, rng, rays)) return false;
  connection.s = static_cast<int>(manifold_->found().size()) - 1;
  if (!wanted(connection.s, t)) return false;

  assembled_.vertices = manifold_->found();
  complete_assembled(connection);
  const ExtraTechnique technique = manifold_->technique(assembled_, assembled_terms_);
  if (!evaluate_assembled(technique, connection)) return false;
  // Russian roulette: what other techniques find more easily is not worth the searches.
  const double roulette = std::min(1.0, 8 * connection.own_share / connection.survival);
  if (!(rng.next() < roulette)) return false;
  connection.searches = manifold_->find_again(time_, rng, rays);
  connection.found_again = manifold_->guess(assembled_terms_) * connection.searches / roulette;
  connection.contribution *= connection.found_again;
  connection.own_share /= connection.found_again;
  return true;
}

}  // namespace mlt
