// Unidirectional path tracing (Kajiya 1986) with next-event estimation, combined with scattering by
// multiple importance sampling (Veach & Guibas 1995, power heuristic). This is the text to read and
// to change first; `path` renders by wave/path_wave.h, which is tested against it (docs/waves.md).
#pragma once

#include "path/direct_light.h"
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
  const SurfacePoint x0 = Scene::point_at_infinity(w, ray.wavelength);
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

struct CameraWalk;

/// A watcher of trace_path: its functions are called at each step, in this order. This one ignores
/// them.
struct IgnorePaths {
  /// Called before hit() or connect(): a path with this radiance was found. Returns the weight with
  /// which it counts in the radiance of the walk.
  double find(const CameraWalk&, const Color& /*radiance*/, double /*certainty*/) const {
    return 1;
  }
  /// A light was hit at x0; `radiance` is the result.
  void hit(const Emitter&, const SurfacePoint& /*x0*/, const Color& /*radiance*/) {}
  void arrive(const SurfacePoint&) {}
  /// The last vertex was connected to a position on a light, sampled by sample_direct_position with
  /// `u`; `radiance` is the result.
  void connect(const Vec3& /*u*/, const Color& /*radiance*/) {}
  void scatter(Lobe) {}
};

/// A walk from the camera, and the radiance that it has found.
struct CameraWalk {
  /// A ray of no length finds nothing: it is outside the field of view.
  CameraWalk(const Ray& first)
      : ray(first), throughput(first.t_max > 0 ? 1.0 : 0.0), previous(first.o) {}

  Ray ray;            ///< The next ray.
  Color radiance{0};  ///< As a film records it.
  Spectrum throughput;
  Vec3 previous;           ///< Its last vertex.
  double scatter_pdf = 0;  ///< Density of the ray in solid angle.
  bool dispersed = false;  ///< See Scattering.
  bool delta = true;       ///< Whether `previous` is the lens, or scattered by a delta.
  double eta2 = 1;         ///< Factor that cancels refraction in the throughput.
  double certainty = 0;    ///< See certainty() of path_terms.h; up to here, if it began with 1.
  double survival = 1;     ///< Probability of having survived Russian roulette.
  Spectrum likelihood{1};  ///< See Passage.

  MisExponent mis{Heuristic::power};  ///< For the two techniques.

  /// The light of a path as a film records it; its last vertex may disperse, too.
  Color seen(const Spectrum& light, bool disperses = false) const {
    return recorded(light, ray.wavelength, dispersed || disperses);
  }

  /// Goes along the ray up to where it stops.
  void pass(const Passage& leg, const Arrival& arrival) {
    const double p = arrival.probability();
    throughput = leg.is_blocked() ? Spectrum(0) : throughput * (leg.transmittance / p);
    scatter_pdf *= p;
    certainty *= p;
    likelihood = arrival.next_likelihood();
  }
};

/// Follows the ray of a walk to where it stops, knowing whether it has hit a surface, and the first
/// that it has; false if it leaves the scene.
inline bool go_through(const Walker& walker, double u_leg, bool hit, CameraWalk& walk,
                       SurfacePoint& at) {
  Passage leg;
  leg.likelihood = walk.likelihood;
  const Vec3& w = walk.ray.d;
  hit = walker.go_on(walk.ray, u_leg, hit, at, leg);
  walk.pass(leg, walker.scene.arrival(leg, hit ? at : Scene::point_at_infinity(w), w));
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

/// Adds the emission where the ray ends: at the surface `at`, or (nullptr) outside the scene.
template <class Watcher = IgnorePaths>
void find_light(const Scene& scene, CameraWalk& walk, const SurfacePoint* at,
                Watcher&& watcher = Watcher()) {
  const Vec3& w = walk.ray.d;
  const auto take = [&](const Emitter& emitter, const SurfacePoint& x0, const Spectrum& emitted) {
    const double weight =
        walk.delta
            ? 1.0
            : walk.mis.weight(walk.scatter_pdf, direct_pdf(scene, emitter, walk.previous, x0, w));
    const Spectrum weighted = walk.throughput * weight;
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
  const auto mis = [&](double light, double bsdf) { return walk.mis.weight(light, bsdf); };
  const DirectLight light =
      direct_light(walker, at, -walk.ray.d, u, rules.strict_normals, mis, walk.likelihood);
  const Color direct = walk.seen(walk.throughput * light.radiance, light.disperses);
  walk.radiance += direct * watcher.find(walk, direct, 0);
  watcher.connect(u, direct);
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
  for (int depth = 1;; ++depth) {
    SurfacePoint at;
    const bool hit = arrive(walker, sampler, walk, at);
    if (rules.wants(depth)) find_light(scene, walk, hit ? &at : nullptr, watcher);
    if (!hit || depth == rules.most_edges()) break;
    watcher.arrive(at);

    if (!consistent_sides(at, -walk.ray.d, rules.strict_normals)) break;
    const VertexNumbers numbers = VertexNumbers::draw(sampler);
    if (wants_direct_light(scene, rules, depth, at))
      add_direct_light(walker, rules, at, numbers.for_light(), walk, watcher);
    if (!scatter(walker, rules, depth, at, numbers, walk, watcher)) break;
  }
  return walk.radiance;
}

}  // namespace mlt
