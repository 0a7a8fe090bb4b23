// Unidirectional path tracing (Kajiya 1986) with next-event estimation, combined with scattering by
// multiple importance sampling (Veach & Guibas 1995, power heuristic).
#pragma once

#include "path/next_event.h"
#include "path/ray_counts.h"
#include "path/scatter.h"

namespace mlt {

struct PathSettings {
  int max_depth = -1;  ///< Edges of the longest path; 1: lights seen directly; -1: unbounded.
  int rr_depth = 5;    ///< From this depth on Russian roulette may end a path.
  bool hide_emitters = false;
  bool strict_normals = false;
};

/// beta = 2 of Veach 1997, eq. 9.13, for two techniques.
inline double power_heuristic(double pdf, double other) {
  return sqr(pdf) / (sqr(pdf) + sqr(other));
}

/// Emission towards the camera of everything at infinity, or of the surface `at` that was hit;
/// `weight(emitter, x0)` is the MIS weight of having found it this way.
template <class Weight>
Color emission(const Scene& scene, const SurfacePoint* at, const Vec3& w, Weight&& weight) {
  if (at) {
    const Emitter* emitter = scene.emitter(*at);
    if (!emitter) return Color(0);
    const Color radiance = emitter->eval(*at, -w);
    return is_black(radiance) ? Color(0) : radiance * weight(*emitter, *at);
  }
  Color sum(0);
  const SurfacePoint x0 = Scene::point_at_infinity(w);
  for (const uint32_t index : scene.infinite_emitters()) {
    const Emitter& emitter = *scene.emitters()[index];
    if (emitter.delta()) continue;
    sum += emitter.eval(x0, -w) * weight(emitter, x0);
  }
  return sum;
}

/// The light that a position on a light, chosen by next-event estimation, sends through `at` towards
/// wc; `weight(pdf_light, pdf_bsdf)` is the MIS weight, of densities in solid angle.
template <class Weight>
Color direct_light(const Scene& scene, const SurfacePoint& at, const Vec3& wc, const Vec3& u,
                   double time, bool strict, RayCounts& rays, Weight&& weight) {
  const EmitterSample light = sample_emitter(scene, at.p, u);
  if (!(light.pdf > 0)) return Color(0);
  const Vec3 wl = direction(at, light.x0);
  if (!consistent_sides(at, wl, strict)) return Color(0);
  const Color radiance = light.emitter->eval(light.x0, -wl);
  if (is_black(radiance)) return Color(0);
  const Vec3 local_l = at.shading.to_local(wl);
  const Scattering s =
      scene.bsdf(at).scattering(at, local_l, at.shading.to_local(wc), Lobe::smooth);
  if (is_black(s.f)) return Color(0);
  ++rays.occluded;
  if (!scene.visible(at, light.x0, time)) return Color(0);
  const double pdf = light.pdf * per_solid_angle(at.p, light.x0, wl);
  const double mis = light.emitter->delta() ? 1.0 : weight(pdf, s.pdf_from_camera);
  return radiance * s.f * (abs_cos_theta(local_l) * mis / pdf);
}

/// Who watches trace_path is told of each step, in this order; this one is not interested.
struct IgnorePaths {
  /// A light was hit at x0; its radiance towards w is to be multiplied by `throughput`.
  void hit(const Emitter&, const SurfacePoint& /*x0*/, const Vec3& /*w*/,
           const Color& /*throughput*/) {}
  void arrive(const SurfacePoint&) {}
  /// A position on a light, which sample_emitter finds by `u`, was seen from there, with this result.
  void connect(const Vec3& /*u*/, const Color& /*radiance*/) {}
  void scatter(Lobe) {}
};

/// The radiance that arrives along `ray` from the scene. Every vertex draws the same number of
/// numbers from the sampler, so that a small change of the numbers is a small change of the path.
template <class Sampler, class Watcher = IgnorePaths>
Color trace_path(const Scene& scene, const PathSettings& settings, Ray ray, Sampler& sampler,
                 RayCounts& rays, Watcher&& watcher = Watcher()) {
  Color radiance(0), throughput(1);
  Vec3 previous = ray.o;
  double scatter_pdf = 0, eta2 = 1;
  bool delta = true;
  const auto found_by_scattering = [&](const Emitter& emitter, const SurfacePoint& x0) {
    double weight = 1;
    if (!delta) {
      const double light_pdf =
          emitter_pdf(scene, emitter, previous, x0) * per_solid_angle(previous, x0, ray.d);
      weight = power_heuristic(scatter_pdf, light_pdf);
    }
    watcher.hit(emitter, x0, -ray.d, throughput * weight);
    return weight;
  };
  for (int depth = 1;; ++depth) {
    SurfacePoint at;
    ++rays.intersect;
    const bool hit = scene.intersect(ray, at);
    if (depth > 1 || !settings.hide_emitters)
      radiance += throughput * emission(scene, hit ? &at : nullptr, ray.d, found_by_scattering);
    if (!hit || depth == settings.max_depth) break;
    watcher.arrive(at);

    const Vec3 wc = -ray.d;
    if (!consistent_sides(at, wc, settings.strict_normals)) break;
    const Bsdf& bsdf = scene.bsdf(at);
    const Vec2 u_light = sampler.next2(), u_direction = sampler.next2();
    const double u_choice = sampler.next(), u_lobe = sampler.next(), u_roulette = sampler.next();
    if (bsdf.has_smooth()) {
      const Vec3 u(u_choice, u_light);
      const Color direct =
          throughput *
          direct_light(scene, at, wc, u, ray.time, settings.strict_normals, rays, power_heuristic);
      watcher.connect(u, direct);
      radiance += direct;
    }

    const auto sample =
        scatter_to_light(bsdf, at, wc, {u_lobe, u_direction}, settings.strict_normals);
    if (!sample) break;
    watcher.scatter(sample->lobe);
    throughput *= sample->weight;
    scatter_pdf = sample->pdf;
    delta = sample->lobe != Lobe::smooth;
    eta2 /= sample->eta2;
    if (depth >= settings.rr_depth) {
      const double survival = std::min(max_component(throughput) * eta2, 0.95);
      if (!(u_roulette < survival)) break;
      throughput /= survival;
    }
    previous = at.p;
    ray = scene.spawn(at, sample->w, ray.time);
  }
  return radiance;
}

}  // namespace mlt
