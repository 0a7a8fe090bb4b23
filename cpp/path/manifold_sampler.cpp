#include "path/manifold_sampler.h"

namespace mlt {

double ManifoldSampler::chain_density(const Vertex* x0, int m, double lobes) const {
  if (m < 1 || m > SpecularChain::most_vertices || !starts_chains(*scene_, *x0)) return 0;
  for (int i = 1; i <= m; ++i)
    if (!has_constraint(*scene_, x0[i])) return 0;
  return guide_->guess(x0, m, lobes) * SpecularChain(*scene_, x0, m).density();
}

ManifoldTechnique ManifoldSampler::technique(const Path& path, const PathTerms& terms) const {
  int s = 1;
  double walk = 1;
  for (; !terms[s].connectable; ++s) walk *= terms[s].from_light;
  if (s == 1 || !(walk > 0)) return {};
  return {s, chain_density(&path[0], s - 1, lobes_pdf(terms, s - 1)) / walk};
}

bool ManifoldSampler::draw_seed(const Vertex& x0, double time, Rng& rng, RayCounts& rays) {
  const Walker walker{*scene_, time, rays};
  Ray ray = ray_through(*scene_, x0.at, guide_->aim(rng), time);
  seed_.assign(1, x0);
  Vertex x;
  while (walker.arrive(ray, 0, x) && scene_->bsdf(x.at).has_delta()) {
    // where a surface is smooth, too, the chain may have ended
    if (seed_.size() > 1 && scene_->bsdf(x.at).has_smooth() && rng.next() < 0.5) break;
    if (seed_.size() > SpecularChain::most_vertices || !has_constraint(*scene_, x)) return false;
    const double u_lobe = rng.next(), u = rng.next();
    const auto next = walker.scatter(x, -ray.d, {u_lobe, u, rng.next()});
    if (!next || !x.delta()) return false;
    seed_.push_back(x);
    ray = *next;
    x = {};
    x.at.p = ray.o + ray.d;  // unless the ray meets a surface
  }
  seed_.push_back(x);
  return seed_.size() > 2;
}

bool ManifoldSampler::search(const Vertex& x0, const SurfacePoint& y, double time, Rng& rng,
                             RayCounts& rays) {
  return draw_seed(x0, time, rng, rays) &&
         walk_.start(*scene_, seed_.data(), static_cast<int>(seed_.size()) - 2) &&
         walk_.go(y, time, rays);
}

bool ManifoldSampler::find(const Vertex& x0, const Vertex& y, double time, Rng& rng,
                           RayCounts& rays) {
  if (!starts_chains(*scene_, x0) || !search(x0, y.at, time, rng, rays)) return false;
  found_.assign(1, x0);
  for (int i = 0; i < walk_.count(); ++i) found_.push_back(walk_[i]);
  found_.push_back(y);
  return guide_->guess(found_.data(), chain_length(), 1) > 0;
}

bool ManifoldSampler::is_found_again() const {
  if (walk_.count() != chain_length()) return false;
  for (int i = 0; i < walk_.count(); ++i)
    if (walk_[i].lobe != found_[i + 1].lobe) return false;
  return walk_.ended_in(found_.data());
}

int ManifoldSampler::find_again(double time, Rng& rng, RayCounts& rays) {
  const int most = guide_->most_searches();
  const SurfacePoint& y = found_.back().at;
  int n = 1;
  while (n < most && !(search(found_.front(), y, time, rng, rays) && is_found_again())) ++n;
  return n;
}

}  // namespace mlt
