#include "path/manifold_sampler.h"

#include "path/samplers.h"

namespace mlt {

double ManifoldSampler::chain_density(const Vertex* x0, int m, double lobes) const {
  if (m < 1 || m > SpecularChain::most_vertices || !starts_chains(*scene_, *x0)) return 0;
  for (int i = 1; i <= m; ++i)
    if (!has_constraint(*scene_, x0[i])) return 0;
  return guide_->guess(x0, m, lobes) * SpecularChain(*scene_, x0, m).density();
}

ExtraTechnique ManifoldSampler::technique(const Path& path, const PathTerms& terms) const {
  int s = 1;
  double walk = 1;
  for (; !terms[s].connectable; ++s) walk *= terms[s].from_light;
  if (s == 1 || !(walk > 0)) return {};
  return {s, chain_density(&path[0], s - 1, lobes_pdf(terms, s - 1)) / walk};
}

bool ManifoldSampler::draw_seed(const Vertex& x0, const Vec3& aim, double time, Rng& rng,
                                RayCounts& rays) {
  const Walker walker{*scene_, time, rays};
  Ray ray = ray_through(*scene_, x0.at, aim, time);
  seed_.assign(1, x0);
  Vertex x;
  bool hit;
  while ((hit = walker.arrive(ray, 0, x)) && scene_->bsdf(x.at).has_delta()) {
    // where a surface is smooth, too, the chain may have ended
    if (seed_.size() > 1 && scene_->bsdf(x.at).has_smooth() && rng.next() < 0.5) break;
    if (seed_.size() > SpecularChain::most_vertices || !has_constraint(*scene_, x)) return false;
    const double u_lobe = rng.next(), u = rng.next();
    const auto next = walker.scatter(x, -ray.d, {u_lobe, u, rng.next()});
    if (!next || !x.delta()) return false;
    seed_.push_back(x);
    ray = *next;
  }
  if (!hit) x.at.p = ray.o + scene_->bounds().radius * ray.d;
  seed_.push_back(x);
  return seed_.size() > 2;
}

bool ManifoldSampler::follow_photon(const Vertex& x0, const ManifoldAim& aim, const SurfacePoint& y,
                                    double time, RayCounts& rays) {
  const Walker walker{*scene_, time, rays};
  Ray ray = ray_through(*scene_, x0.at, aim.at, time);
  seed_.assign(1, x0);
  for (int i = count_lobes(aim.lobes) - 1; i >= 0; --i) {
    Vertex& x = seed_.emplace_back();
    if (!walker.arrive(ray, 0, x) || !scene_->bsdf(x.at).has_delta()) return false;
    if (!has_constraint(*scene_, x)) return false;
    x.lobe = static_cast<Lobe>(aim.lobes >> 2 * i & 3);
    const SpecularScattering kept{true, x.lobe == Lobe::reflection};
    const auto out = scattered_direction(*scene_, x, kept, -ray.d);
    if (!out) return false;
    ray = walker.leave(x.at, *out);
  }
  const double along = dot(y.p - ray.o, ray.d);
  seed_.emplace_back().at.p = ray.o + along * ray.d;
  return along > 0;
}

bool ManifoldSampler::search(const Vertex& x0, const Vertex& y, double time, Rng& rng,
                             RayCounts& rays) {
  const ManifoldAim aim = guide_->aim(x0, y, rng);
  const bool drawn = aim.lobes > 0 ? follow_photon(x0, aim, y.at, time, rays)
                                   : draw_seed(x0, aim.at, time, rng, rays);
  return drawn && walk_.start(*scene_, seed_.data(), static_cast<int>(seed_.size()) - 2) &&
         walk_.go(y.at, time, rays);
}

void ManifoldSampler::send_photon(Rng& rng, RayCounts& rays, ManifoldPhotons& photons) {
  RandomSampler sampler(rng);
  const SurfacePoint lens = sample_lens(scene_->camera(), sampler).at;
  const double u = sampler.next();
  const Vec2 u_position = sampler.next2();
  const LightSample light =
      sample_light_position(*scene_, {u, u_position.x, u_position.y}, lens.time, lens.wavelength);
  if (!(light.x0.pdf > 0)) return;
  const Vertex x0 = light_vertex(*light.emitter, light.x0.at);
  if (!starts_chains(*scene_, x0)) return;
  if (!draw_seed(x0, guide_->aim_blindly(rng), lens.time, rng, rays)) return;
  if (is_black(light.emitted(direction(x0.at, seed_[1].at)))) return;
  const int m = static_cast<int>(seed_.size()) - 2;
  const SurfacePoint &last = seed_[m].at, &end = seed_[m + 1].at;
  ManifoldPhoton photon{end.p, seed_[1].at.p, lobes_of(seed_.data(), m)};
  const bool hit = end.shape != SurfacePoint::no_shape;
  if (hit && scene_->bsdf(end).has_smooth()) photons.add(x0, VertexKind::inner, photon);
  const Vec3 w = direction(last, end);
  const double along = dot(lens.p - last.p, w);
  if (!(along > 0) || (hit && along > length(end.p - last.p))) return;
  photon.at = last.p + along * w;
  photons.add(x0, VertexKind::camera, photon);
}

bool ManifoldSampler::find(const Vertex& x0, const Vertex& y, double time, Rng& rng,
                           RayCounts& rays) {
  if (!starts_chains(*scene_, x0) || !search(x0, y, time, rng, rays)) return false;
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
  const Vertex& y = found_.back();
  int n = 1;
  while (n < most && !(search(found_.front(), y, time, rng, rays) && is_found_again())) ++n;
  return n;
}

}  // namespace mlt
