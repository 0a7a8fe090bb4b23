// Unidirectional path tracing (Kajiya 1986) with next-event estimation, combined with scattering by
// multiple importance sampling (Veach & Guibas 1995, power heuristic). This is the text to read and
// to change first; `path` renders by wave/path_wave.h, which is tested against it (docs/waves.md).
#pragma once

#include "path/light_techniques.h"

namespace mlt {

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
  if (walk.inside) walk.inside->leave(walker, at);
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

/// The radiance from the scene along the ray of a walk, as a film records it. Every vertex draws
/// the same number of random numbers, so that a small change of the numbers is a small change of
/// the path.
template <class Sampler, class Watcher = IgnorePaths>
Color trace_path(const Scene& scene, const PathRules& rules, CameraWalk walk, Sampler& sampler,
                 RayCounts& rays, Watcher&& watcher = Watcher()) {
  const Walker walker{scene, walk.ray.time, rays};
  std::optional<Approaches> approaches;
  if (rules.equiangular && scene.has_media()) walk.approaches = &approaches.emplace();
  std::optional<LegsInside> inside;
  if (rules.through_boundaries && RefractedLight::serves(scene)) walk.inside = &inside.emplace();
  for (int depth = 1;; ++depth) {
    SurfacePoint at;
    const bool hit = arrive(walker, sampler, walk, at);
    if (walk.inside && hit) walk.inside->arrive(at, walk.ray.d, walk.scatter_pdf);
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
    const StepNumbers refracted = walk.inside ? StepNumbers::draw(sampler) : StepNumbers();
    add_sampled_light(walker, rules, depth, at, numbers.for_light(), refracted, walk, watcher);
    if (!scatter(walker, rules, depth, at, numbers, walk, watcher)) break;
  }
  return walk.radiance;
}

}  // namespace mlt
