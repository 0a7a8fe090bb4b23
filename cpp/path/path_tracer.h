// Unidirectional path tracing (Kajiya 1986) with next-event estimation, combined with scattering by
// multiple importance sampling (Veach & Guibas 1995, power heuristic).
#pragma once

#include "path/path_rules.h"
#include "path/walk.h"

namespace mlt {

/// beta = 2 of Veach 1997, eq. 9.13, for two techniques.
inline double power_heuristic(double pdf, double other) {
  return sqr(pdf) / (sqr(pdf) + sqr(other));
}

/// d(measure of x0) / d(solid angle of w at `from`): turns a density at x0 into one over
/// directions. w points from `from` to x0.
inline double per_solid_angle(const Vec3& from, const SurfacePoint& x0, const Vec3& w) {
  if (x0.infinite()) return 1;
  return length_squared(x0.p - from) / abs_cos(x0, w);
}

/// Density in solid angle with which next-event estimation at `from` chooses x0, seen along w.
inline double direct_pdf(const Scene& scene, const Emitter& emitter, const Vec3& from,
                         const SurfacePoint& x0, const Vec3& w) {
  return scene.emitter_probability(emitter.index()) * emitter.pdf_direct(from, x0) *
         per_solid_angle(from, x0, w);
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

/// The light that a position on a light, chosen by next-event estimation, sends through `at`
/// towards wc; `weight(pdf_light, pdf_bsdf)` is the MIS weight, of densities in solid angle.
template <class Weight>
Color direct_light(const Walker& walker, const SurfacePoint& at, const Vec3& wc, const Vec3& u,
                   bool strict, Weight&& weight) {
  const LightSample light = sample_direct_position(walker.scene, at, u);
  if (!(light.pdf > 0)) return Color(0);
  const Vec3 wl = direction(at, light.x0);
  if (!consistent_sides(at, wl, strict)) return Color(0);
  const Color radiance = light.emitter->eval(light.x0, -wl);
  if (is_black(radiance)) return Color(0);
  const WorldScattering s = scattering(walker.scene.bsdf(at), at, wl, wc, Lobe::smooth);
  if (is_black(s.f)) return Color(0);
  const double seen = walker.join(at, light.x0);
  if (seen == 0) return Color(0);
  const double pdf = light.pdf * per_solid_angle(at.p, light.x0, wl);
  const double mis = light.emitter->delta() ? 1.0 : weight(pdf, s.pdf_from_camera);
  return radiance * s.f * (seen * std::abs(s.cos_l) * mis / pdf);
}

/// One scattering event of a walk from the camera.
struct ScatterSample {
  Vec3 w;        ///< Towards the light side.
  Color weight;  ///< Of radiance: f |cos| / pdf.
  double pdf;    ///< Solid angle, or the probability of the delta lobe.
  Lobe lobe;
  double eta2;  ///< The factor of radiance in `weight` that is due to refraction alone.
};

/// Samples the direction from which the light that goes on along wc may have come.
inline std::optional<ScatterSample> scatter_to_light(const Walker& walker, const SurfacePoint& at,
                                                     const Vec3& wc, const Vec3& u, bool strict) {
  const auto sample = walker.scatter(at, wc, u);
  if (!sample) return std::nullopt;
  const auto& [w, local_c, local_l, lobe] = *sample;
  if (lobe != Lobe::null && !consistent_sides(at, w, strict)) return std::nullopt;
  const Bsdf& bsdf = walker.scene.bsdf(at);
  const Scattering s = at.matte.known() ? at.matte.scattering(local_l.z, local_c.z, lobe)
                                        : bsdf.scattering(at, local_l, local_c, lobe);
  if (!(s.pdf_from_camera > 0) || is_black(s.f)) return std::nullopt;

  const bool refracted =
      lobe == Lobe::transmission || (lobe == Lobe::smooth && !same_side(local_l, local_c));
  const double eta2 = refracted ? sqr(bsdf.relative_eta(at, local_c)) : 1.0;
  const double factor = lobe == Lobe::smooth ? abs_cos_theta(local_l) : eta2;
  return ScatterSample{w, s.f * (factor / s.pdf_from_camera), s.pdf_from_camera, lobe, eta2};
}

/// Who watches trace_path is told of each step, in this order; this one is not interested.
struct IgnorePaths {
  /// A light was hit at x0; its radiance towards w is to be multiplied by `throughput`.
  void hit(const Emitter&, const SurfacePoint& /*x0*/, const Vec3& /*w*/,
           const Color& /*throughput*/) {}
  void arrive(const SurfacePoint&) {}
  /// A position on a light, which sample_direct_position finds by `u`, was seen from there, with
  /// this result.
  void connect(const Vec3& /*u*/, const Color& /*radiance*/) {}
  void scatter(Lobe) {}
};

/// The radiance that arrives along `ray` from the scene. Every vertex draws the same number of
/// numbers from the sampler, so that a small change of the numbers is a small change of the path.
template <class Sampler, class Watcher = IgnorePaths>
Color trace_path(const Scene& scene, const PathRules& rules, Ray ray, Sampler& sampler,
                 RayCounts& rays, Watcher&& watcher = Watcher()) {
  const Walker walker{scene, ray.time, rays};
  Color radiance(0), throughput(1);
  Vec3 previous = ray.o;
  double scatter_pdf = 0, eta2 = 1;
  bool delta = true;
  const auto found_by_scattering = [&](const Emitter& emitter, const SurfacePoint& x0) {
    const double weight =
        delta ? 1.0 : power_heuristic(scatter_pdf, direct_pdf(scene, emitter, previous, x0, ray.d));
    watcher.hit(emitter, x0, -ray.d, throughput * weight);
    return weight;
  };
  for (int depth = 1;; ++depth) {
    SurfacePoint at;
    const bool hit = walker.arrive(ray, at);
    if (rules.wants(depth))
      radiance += throughput * emission(scene, hit ? &at : nullptr, ray.d, found_by_scattering);
    if (!hit || depth == rules.most_edges()) break;
    watcher.arrive(at);

    const Vec3 wc = -ray.d;
    if (!consistent_sides(at, wc, rules.strict_normals)) break;
    const Vec2 u_light = sampler.next2(), u_direction = sampler.next2();
    const double u_choice = sampler.next(), u_lobe = sampler.next(), u_roulette = sampler.next();
    if ((at.matte.known() || scene.bsdf(at).has_smooth()) && rules.wants(depth + 1)) {
      const Vec3 u(u_choice, u_light);
      const Color direct =
          throughput * direct_light(walker, at, wc, u, rules.strict_normals, power_heuristic);
      watcher.connect(u, direct);
      radiance += direct;
    }

    const auto sample =
        scatter_to_light(walker, at, wc, {u_lobe, u_direction}, rules.strict_normals);
    if (!sample) break;
    watcher.scatter(sample->lobe);
    throughput *= sample->weight;
    scatter_pdf = sample->pdf;
    delta = sample->lobe != Lobe::smooth;
    eta2 /= sample->eta2;
    if (depth >= rules.rr_depth) {
      const double survival = std::min(max_component(throughput) * eta2, 0.95);
      if (!(u_roulette < survival)) break;
      throughput /= survival;
    }
    previous = at.p;
    ray = walker.leave(at, sample->w);
  }
  return radiance;
}

}  // namespace mlt
