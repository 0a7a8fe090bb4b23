// Unidirectional path tracing (Kajiya 1986) with next-event estimation, combined with scattering by
// multiple importance sampling (Veach & Guibas 1995, power heuristic). This is the text to read and
// to change first; `path` renders by wave/path_wave.h, which is tested against it (docs/waves.md).
#pragma once

#include "path/camera_walk.h"
#include "path/mis.h"
#include "path/path_rules.h"

namespace mlt {

/// Finds the emission towards the camera where a ray ends: calls visit(emitter, x0,
/// radiance) for the surface `at` that was hit, or (nullptr) for every light at infinity.
template <class Visit>
void visit_emission(const Scene& scene, const SurfacePoint* at, const Ray& ray, Visit&& visit) {
  const Vec3& w = ray.d;
  if (at) {
    const Emitter* emitter = scene.emitter(*at);
    if (!emitter || emitter->delta_direction()) return;
    const Spectrum radiance = emitter->eval(*at, -w);
    if (!is_black(radiance)) visit(*emitter, *at, radiance);
    return;
  }
  if (scene.backgrounds().empty()) return;
  const SurfacePoint x0 = Scene::point_at_infinity(ray);
  for (const uint32_t index : scene.backgrounds()) {
    const Emitter& emitter = *scene.emitters()[index];
    visit(emitter, x0, emitter.eval(x0, -w));
  }
}

/// The sum of that emission; `weight(emitter, x0)` is the MIS weight of having hit x0.
template <class Weight>
Spectrum emission(const Scene& scene, const SurfacePoint* at, const Ray& ray, Weight&& weight) {
  Spectrum sum(0);
  visit_emission(scene, at, ray,
                 [&](const Emitter& emitter, const SurfacePoint& x0, const Spectrum& radiance) {
                   sum += radiance * weight(emitter, x0);
                 });
  return sum;
}

/// One scattering event of a walk from the camera.
struct ScatterSample {
  Vec3 w;           ///< Direction to the light side.
  Spectrum weight;  ///< Factor of radiance: f |cos| / pdf.
  double pdf;       ///< In solid angle, or the probability of the delta lobe.
  Lobe lobe;
  double eta2;     ///< The factor of radiance in `weight` that is due to refraction alone.
  bool disperses;  ///< See Scattering.
};

/// Samples the direction of the incident light that is scattered towards wc.
inline std::optional<ScatterSample> scatter_to_light(const Walker& walker, const SurfacePoint& at,
                                                     const Vec3& wc, const Vec3& u, bool strict) {
  const BsdfAt bsdf(walker.scene, at);
  const auto sample = bsdf.sample(wc, u);
  if (!sample) return std::nullopt;
  const auto& [w, local_c, local_l, lobe] = *sample;
  if (!consistent_sides(at, w, strict)) return std::nullopt;
  const Scattering s = bsdf.local_scattering(local_l, local_c, lobe);
  if (!(s.pdf_from_camera > 0) || is_black(s.f)) return std::nullopt;

  const bool refracted =
      lobe == Lobe::transmission || (lobe == Lobe::smooth && !same_side(local_l, local_c));
  const double eta2 = refracted ? sqr(bsdf.relative_eta(local_c)) : 1.0;
  const double factor = lobe == Lobe::smooth ? bsdf.abs_cos(local_l) : eta2;
  return ScatterSample{
      w, s.f * (factor / s.pdf_from_camera), s.pdf_from_camera, lobe, eta2, s.disperses};
}

/// Follows the ray of a walk to where it stops, knowing whether it has hit a surface, and the first
/// that it has; false if it leaves the scene.
inline bool go_through(const Walker& walker, double u_leg, bool hit, CameraWalk& walk,
                       SurfacePoint& at) {
  Passage leg;
  leg.likelihood = walk.likelihood;
  Stretch first;
  const Vec3& w = walk.ray.d;
  hit = walker.go_on(walk.ray, u_leg, hit, at, leg, first);
  walk.begin_leg(first);
  walk.pass(leg, walker.scene.arrival(leg, hit ? at : Scene::point_at_infinity(walk.ray), w));
  if (hit && at.in_medium()) walk.certainty = 0;
  return hit;
}

/// Follows the ray of a walk to the next vertex; false if it leaves the scene.
template <class Sampler>
bool arrive(const Walker& walker, Sampler& sampler, CameraWalk& walk, SurfacePoint& at) {
  const double u_leg = walker.draw_leg(sampler);
  const bool hit = walker.intersect(walk.ray, at);
  return walker.scene.has_passages() ? go_through(walker, u_leg, hit, walk, at) : hit;
}

/// The weight of having hit x0 on a light from the last vertex.
inline double hit_weight(const Scene& scene, const CameraWalk& walk, const Emitter& emitter,
                         const SurfacePoint& x0) {
  if (walk.delta) return 1;
  const Vec3& w = walk.ray.d;
  const double direct = direct_pdf(scene, emitter, walk.previous, x0, w);
  if (!walk.approaches) return walk.mis.weight(walk.scatter_pdf, direct);
  return walk.mis.weight(walk.scatter_pdf, direct,
                         walk.approaches->previous.direct_pdf(scene, emitter, x0, w));
}

/// Adds the emission where the ray ends: at the surface `at`, or (nullptr) outside the scene.
template <class Watcher = IgnorePaths>
void find_light(const Scene& scene, CameraWalk& walk, const SurfacePoint* at,
                Watcher&& watcher = Watcher()) {
  const auto take = [&](const Emitter& emitter, const SurfacePoint& x0, const Spectrum& emitted) {
    const Spectrum weighted = walk.throughput * hit_weight(scene, walk, emitter, x0);
    const Color found = walk.seen(weighted * emitted);
    walk.radiance += found * watcher.find(walk, found, walk.certainty);
    watcher.hit(emitter, x0, found);
  };
  visit_emission(scene, at, walk.ray, take);
}

/// Russian roulette with the throughput, from rr_depth on; false ends the walk.
inline bool survive(const PathRules& rules, int depth, double u, CameraWalk& walk) {
  if (vanishes(walk.throughput)) return false;
  if (depth < rules.rr_depth) return true;
  const double survival = PathRules::survival(max_component(walk.throughput) * walk.eta2);
  if (!(u < survival)) return false;
  walk.throughput /= survival;
  walk.survival *= survival;
  return true;
}

/// Goes on in the direction that was sampled at the surface that is the depth-th vertex after the
/// lens; false ends the walk.
template <class Watcher = IgnorePaths>
bool go_on(const Walker& walker, const PathRules& rules, int depth, const SurfacePoint& at,
           const ScatterSample& sample, double u_roulette, CameraWalk& walk,
           Watcher&& watcher = Watcher()) {
  watcher.scatter(sample.lobe);
  walk.throughput *= sample.weight;
  walk.scatter_pdf = sample.pdf;
  walk.dispersed = walk.dispersed || sample.disperses;
  walk.delta = sample.lobe != Lobe::smooth;
  if (walk.certainty > 0)
    walk.certainty *=
        walk.delta
            ? delta_terms(walker.scene, at, sample.lobe, sample.w, -walk.ray.d).pdf_from_camera
            : 0;
  walk.eta2 /= sample.eta2;
  if (!survive(rules, depth, u_roulette, walk)) return false;
  walk.previous = at.p;
  walk.ray = walker.leave(at, sample.w);
  return true;
}

/// Samples a direction at that surface and goes on in it; false ends the walk.
template <class Watcher = IgnorePaths>
bool scatter(const Walker& walker, const PathRules& rules, int depth, const SurfacePoint& at,
             const VertexNumbers& numbers, CameraWalk& walk, Watcher&& watcher = Watcher()) {
  const auto sample =
      scatter_to_light(walker, at, -walk.ray.d, numbers.for_scattering(), rules.strict_normals);
  return sample && go_on(walker, rules, depth, at, *sample, numbers.roulette, walk, watcher);
}

/// Adds the light of a light that u samples for that surface.
template <class Watcher = IgnorePaths>
void add_direct_light(const Walker& walker, const PathRules& rules, const SurfacePoint& at,
                      const Vec3& u, CameraWalk& walk, Watcher&& watcher = Watcher()) {
  const LightSample chosen = sample_direct_position(walker.scene, at, u);
  const SurfacePoint& x0 = chosen.x0.at;
  const double approached =
      walk.approaches && chosen.x0.pdf > 0
          ? walk.approaches->now.direct_pdf(walker.scene, *chosen.emitter, x0, direction(at, x0))
          : 0;
  const auto mis = [&](double light, double bsdf) {
    return walk.mis.weight(light, bsdf, approached);
  };
  const DirectLight light =
      direct_light(walker, at, -walk.ray.d, chosen, rules.strict_normals, mis, walk.likelihood);
  const Color direct = walk.seen(walk.throughput * light.radiance, light.disperses);
  walk.radiance += direct * watcher.find(walk, direct, 0);
  watcher.connect(chosen, direct);
}

/// Adds light that is scattered on the leg where it is near to a light (approach.h).
template <class Watcher = IgnorePaths>
void add_approach(const Walker& walker, const PathRules& rules, const ApproachNumbers& u,
                  CameraWalk& walk, Watcher&& watcher = Watcher()) {
  const Scene& scene = walker.scene;
  const Approach& approach = walk.approaches->now;
  if (!approach.exists()) return;
  const EmitterChoice choice = approach.choose(scene, u.light.choice);
  const Equiangular distances = approach.distances(*choice.emitter);
  const double t = distances.sample(u.distance), pdf = distances.pdf(t);
  if (!(pdf > 0)) return;

  const SurfacePoint at = approach.point(t);
  const LightSample chosen = sample_direct_position(scene, at, choice, u.light.position);
  const Passage flight = approach.flight(scene, t);
  const Arrival arrival = scene.arrival(flight, at, approach.direction());
  const double at_vertex = scene.emitter_probability_for(choice.index, at.p) / choice.probability;
  const auto mis = [&](double light, double phase) {
    return walk.mis.weight(light * (pdf / arrival.flown()), light * at_vertex, phase);
  };
  const DirectLight light = direct_light(walker, at, -approach.direction(), chosen,
                                         rules.strict_normals, mis, arrival.next_likelihood());
  const Spectrum throughput = approach.throughput() * flight.transmittance / pdf;
  const Color found = walk.seen(throughput * light.radiance, light.disperses);
  walk.radiance += found * watcher.find(walk, found, 0);
  watcher.connect_between(at, chosen, found);
}

/// Whether lights are sampled for the depth-th vertex after the lens.
inline bool wants_direct_light(const Scene& scene, const PathRules& rules, int depth,
                               const SurfacePoint& at) {
  return BsdfAt(scene, at).has_smooth() && rules.wants(depth + 1);
}

/// The radiance from the scene along the ray of a walk, as a film records it. Every vertex draws
/// the same number of random numbers, so that a small change of the numbers is a small change of
/// the path.
template <class Sampler, class Watcher = IgnorePaths>
Color trace_path(const Scene& scene, const PathRules& rules, CameraWalk walk, Sampler& sampler,
                 RayCounts& rays, Watcher&& watcher = Watcher()) {
  const Walker walker{scene, walk.ray.time, rays};
  std::optional<Approaches> approaches;
  if (rules.equiangular && scene.has_media()) walk.approaches = &approaches.emplace();
  for (int depth = 1;; ++depth) {
    SurfacePoint at;
    const bool hit = arrive(walker, sampler, walk, at);
    if (rules.wants(depth)) find_light(scene, walk, hit ? &at : nullptr, watcher);
    if (depth == rules.most_edges()) break;
    const bool goes_on = hit && consistent_sides(at, -walk.ray.d, rules.strict_normals);
    if (!goes_on && !walk.approaches) break;
    const VertexNumbers numbers = VertexNumbers::draw(sampler);
    if (walk.approaches) {
      const ApproachNumbers u = ApproachNumbers::draw(sampler);
      if (rules.wants(depth + 1)) add_approach(walker, rules, u, walk, watcher);
    }
    if (!goes_on) break;

    watcher.arrive(at);
    if (wants_direct_light(scene, rules, depth, at))
      add_direct_light(walker, rules, at, numbers.for_light(), walk, watcher);
    if (!scatter(walker, rules, depth, at, numbers, walk, watcher)) break;
  }
  return walk.radiance;
}

}  // namespace mlt
