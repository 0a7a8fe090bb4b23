// The techniques by which a walk from the camera finds light, and the weights among them: it hits a
// light, samples one (next-event estimation), or has the techniques of approach.h and
// refracted_light.h, too.
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

/// The weight of having hit x0 on a light from the last vertex.
inline double hit_weight(const Scene& scene, const CameraWalk& walk, const Emitter& emitter,
                         const SurfacePoint& x0) {
  if (walk.delta) return 1;
  const Vec3& w = walk.ray.d;
  const double direct = direct_pdf(scene, emitter, walk.previous, x0, w);
  double third = 0;  // A vertex is in a medium, or on a boundary: no path has all four.
  if (walk.approaches) third = walk.approaches->previous.direct_pdf(scene, emitter, x0, w);
  if (walk.inside) third += walk.inside->previous.direct_pdf(emitter, walk.previous, x0, w);
  return walk.mis.weight(walk.scatter_pdf, direct, third);
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

/// Adds the light that comes straight from that position.
template <class Watcher = IgnorePaths>
void add_direct_light(const Walker& walker, const PathRules& rules, const SurfacePoint& at,
                      const LightSample& chosen, CameraWalk& walk, Watcher&& watcher = Watcher()) {
  const SurfacePoint& x0 = chosen.x0.at;
  const auto mis = [&](double light, double bsdf) {
    const Vec3 w = direction(at, x0);
    double third = 0;
    if (walk.approaches)
      third = walk.approaches->now.direct_pdf(walker.scene, *chosen.emitter, x0, w);
    if (walk.inside) third += walk.inside->now.direct_pdf(*chosen.emitter, at.p, x0, w);
    return walk.mis.weight(light, bsdf, third);
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

/// Adds light from that position that comes to a vertex x in a medium by the technique of
/// refracted_light.h.
template <class Watcher = IgnorePaths>
void add_refracted_light(const Walker& walker, const PathRules& rules, const SurfacePoint& x,
                         const LightSample& chosen, RefractedLight& refracted, const StepNumbers& u,
                         CameraWalk& walk, Watcher&& watcher = Watcher()) {
  const auto sampled = refracted.sample(u);
  if (!sampled) return;
  const auto& [w, pdf, y, leg] = *sampled;
  const Scene& scene = walker.scene;
  const WorldScattering at_x = BsdfAt(scene, x).scattering(w, -walk.ray.d, Lobe::smooth);
  const Arrival arrival = scene.arrival(leg, y, w).after(walk.likelihood);
  const double walked = at_x.pdf_from_camera * arrival.probability() / pdf;
  const Vec3 wz = direction(y, chosen.x0.at);
  const double direct = direct_pdf(scene, *chosen.emitter, y.p, chosen.x0.at, wz) * walked;
  const auto mis = [&](double light, double bsdf) {
    return walk.mis.weight(light, direct, bsdf * walked);
  };
  const DirectLight light =
      direct_light(walker, y, -w, chosen, rules.strict_normals, mis, arrival.next_likelihood());
  const Spectrum throughput = walk.throughput * at_x.f * leg.transmittance / pdf;
  const Color found = walk.seen(throughput * light.radiance, light.disperses);
  walk.radiance += found * watcher.find(walk, found, 0);
  watcher.connect_between(y, chosen, found);
}

/// Whether lights are sampled for the depth-th vertex after the lens.
inline bool wants_direct_light(const Scene& scene, const PathRules& rules, int depth,
                               const SurfacePoint& at) {
  return BsdfAt(scene, at).has_smooth() && rules.wants(depth + 1);
}

/// Samples a light for the depth-th vertex after the lens, and adds what comes from there straight
/// or through a boundary.
template <class Watcher = IgnorePaths>
void add_sampled_light(const Walker& walker, const PathRules& rules, int depth,
                       const SurfacePoint& at, const Vec3& u, const StepNumbers& u_refracted,
                       CameraWalk& walk, Watcher&& watcher = Watcher()) {
  if (!BsdfAt(walker.scene, at).has_smooth()) return;
  const LightSample chosen = sample_direct_position(walker.scene, at, u);
  if (!(chosen.x0.pdf > 0)) return;
  if (walk.inside && at.in_medium() && RefractedLight::serves(*chosen.emitter)) {
    RefractedLight refracted(walker, at, chosen.x0.at);
    if (refracted.exists()) {
      if (rules.wants(depth + 2))
        add_refracted_light(walker, rules, at, chosen, refracted, u_refracted, walk, watcher);
      return;
    }
  }
  if (rules.wants(depth + 1)) add_direct_light(walker, rules, at, chosen, walk, watcher);
}

}  // namespace mlt
