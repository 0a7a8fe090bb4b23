// A technique of path tracing for light that enters a medium through a rough boundary, as of wax or
// skin: next-event estimation through one refraction. For a vertex x in the medium a position z on
// a light is sampled as for light that comes straight. Where light from z would enter if the
// boundary were smooth, a direction is sampled in which the boundary scatters this light; a ray
// from x against it finds the vertex y, which is connected with z.
//
// A smooth boundary asks for the exact y (Walter et al. 2009, "Single scattering in refractive
// media with triangle mesh boundaries"). A rough one sends light to x from all around that point: a
// few steps towards it are enough, and the density is that of the rough scattering.
//
// In bidirectional path tracing it stands beside technique s = 2, and counts
//
//   density of x_0 and x_1 given x_2 / (from_light of x_0 and x_1)
//
// times in TechniqueSums.
#pragma once

#include "math/fresnel.h"
#include "path/direct_light.h"
#include "path/path_terms.h"

namespace mlt {

class RefractedLight {
 public:
  /// Whether light is sampled so. Lights at infinity that can be hit are large, and walks hit them.
  static bool serves(const Emitter& light) { return !light.infinite() || light.delta(); }
  static bool serves(const Scene& scene) {
    const auto& lights = scene.emitters();
    return scene.has_rough_boundaries() &&
           std::any_of(lights.begin(), lights.end(), [](const auto& it) { return serves(*it); });
  }
  /// Light from z for a point x in a medium.
  RefractedLight(const Walker& walker, const SurfacePoint& x, const SurfacePoint& z)
      : walker_(&walker), x_(&x), z_(&z), w_(direction(x, z)), exists_(meet(w_)) {
    if (!exists_) return;
    Passage leg;
    fly(scene().media()[x.medium], walker.leave(x, w_), length(y_.p - x.p), leg);
    share_ = std::min(1.0, most_share * mean(leg.transmittance));
  }

  /// Whether a ray along w that is sampled ends at y, whatever it passes before.
  static bool ends_at(const Scene& scene, const SurfacePoint& y, const Vec3& w) {
    return !y.in_medium() && scene.passage(y, w).is_blocked();
  }

  /// Whether a rough boundary lies between them, so that no light goes straight.
  bool exists() const { return exists_; }
  /// Where a ray along a direction that is sampled ends.
  struct Entrance {
    Vec3 w;          ///< From x.
    double pdf;      ///< Its density, in solid angle.
    SurfacePoint y;  ///< On a boundary.
    Passage leg;     ///< From x to y.
  };
  /// Samples a direction; often none where the boundary is far away.
  std::optional<Entrance> sample(const StepNumbers& u) {
    if (!(u.roulette < share_)) return std::nullopt;
    come_closer();
    const auto scattered = BsdfAt(scene(), y_).sample(to_light(), u.for_scattering());
    if (!scattered || scattered->lobe != Lobe::smooth) return std::nullopt;
    Entrance found;
    found.w = -scattered->w;
    found.pdf = share_ * scattering_pdf(found.w);
    const bool ends = found.pdf > 0 &&
                      walker_->arrive(walker_->leave(*x_, found.w), 0, found.y, found.leg) &&
                      ends_at(scene(), found.y, found.w);
    return ends ? std::optional(found) : std::nullopt;
  }
  double pdf(const Vec3& w) {
    if (!exists_) return 0;
    come_closer();
    return share_ * scattering_pdf(w);
  }

 private:
  static constexpr int most_steps = 2;
  static constexpr double least_step = 0.05;  ///< In radians.
  static constexpr double most_share = 4;     ///< Times the transmittance.

  const Scene& scene() const { return walker_->scene; }
  Vec3 to_light() const { return direction(y_, *z_); }
  double scattering_pdf(const Vec3& w) const {
    return BsdfAt(scene(), y_).scattering(-w, to_light(), Lobe::smooth).pdf_from_camera;
  }

  /// Moves y to where the ray from x along w meets a rough boundary; false if it meets none before
  /// the light.
  bool meet(const Vec3& w) {
    SurfacePoint y;
    if (!walker_->intersect(walker_->leave(*x_, w), y)) return false;
    const bool between = dot(direction(y, *z_), y.ng) * dot(w, y.ng) > 0;
    if (!between || !scene().bsdf(y).scatters_through() || !scene().passage(y, w).is_blocked())
      return false;
    y_ = y;
    return true;
  }
  /// Moves y towards where a smooth boundary would refract the light to x.
  void come_closer() {
    for (int step = 0; step < most_steps; ++step) {
      const Vec3 next = against_refraction();
      if (length_squared(next - w_) < sqr(least_step) || !meet(next)) return;
      w_ = next;
    }
  }
  /// The direction against that in which light at y is refracted into the medium.
  Vec3 against_refraction() const {
    const Vec3 wz = y_.shading.to_local(to_light());
    const double ratio = BsdfAt(scene(), y_).relative_eta(wz);
    const Fresnel fresnel = fresnel_dielectric(wz.z, wz.z >= 0 ? 1 / ratio : ratio);
    return -y_.shading.to_world(refract(wz, fresnel.cos_t, fresnel.eta_ti));
  }

  const Walker* walker_;
  const SurfacePoint *x_, *z_;
  Vec3 w_;          ///< From x to y.
  SurfacePoint y_;  ///< On the boundary.
  bool exists_;
  double share_ = 0;  ///< The probability with which a direction is sampled.
};

/// The density with which the technique samples z, in its own measure, times that of the direction
/// w from x, in solid angle.
inline double refracted_pdf(const Walker& walker, const Emitter& light, const SurfacePoint& x,
                            const Vec3& w, const SurfacePoint& z) {
  if (!RefractedLight::serves(light)) return 0;
  const double entering = RefractedLight(walker, x, z).pdf(w);
  if (!(entering > 0)) return 0;
  const double choice = walker.scene.emitter_probability_for(light.index(), x.p);
  return choice * light.pdf_direct(x.p, z) * entering;
}

/// The density with which the technique makes x_0 and x_1 for x_2, in product-area measure.
inline double refracted_density(const Walker& walker, const Vertex& x0, const Vertex& x1,
                                const Vertex& x2) {
  if (!x2.at.in_medium()) return 0;
  const Vec3 w = direction(x2.at, x1.at);
  if (!RefractedLight::ends_at(walker.scene, x1.at, w)) return 0;
  const Emitter& light = *walker.scene.emitters()[x0.emitter];
  return refracted_pdf(walker, light, x2.at, w, x0.at) * geometry(x1.at, x2.at);
}

/// The technique in the terms of a whole path.
inline ExtraTechnique refracted_technique(const Walker& walker, const Path& path,
                                          const PathTerms& terms) {
  if (path.edges() < 3 || !terms[1].connectable) return {};
  const double refracted = refracted_density(walker, path[0], path[1], path[2]);
  return {2, refracted > 0 ? refracted / (terms[0].from_light * terms[1].from_light) : 0};
}

/// A leg of a walk from a vertex x in a medium to a surface.
struct LegInside {
  const Walker* walker = nullptr;
  std::optional<SurfacePoint> x;  ///< None if there is no such leg.
  Vec3 w{0};
  double pdf = 0;  ///< The density in solid angle with which the walk has come to its end.

  /// The density in solid angle with which the technique makes the direction wz from the end y of
  /// the leg to z, over the probability of coming there by the walk.
  double direct_pdf(const Emitter& light, const Vec3& y, const SurfacePoint& z,
                    const Vec3& wz) const {
    if (!x || !(pdf > 0)) return 0;
    return refracted_pdf(*walker, light, *x, w, z) * per_solid_angle(y, z, wz) / pdf;
  }
};

/// The last two legs of a walk that has the technique.
struct LegsInside {
  LegInside now, previous;

  /// Begins a leg at x.
  void leave(const Walker& walker, const SurfacePoint& x) {
    previous = now;
    now = {};
    if (x.in_medium()) now = {&walker, x};
  }
  /// Ends it at y.
  void arrive(const SurfacePoint& y, const Vec3& w, double pdf) {
    if (now.x && !RefractedLight::ends_at(now.walker->scene, y, w)) now.x.reset();
    now.w = w;
    now.pdf = pdf;
  }
};

}  // namespace mlt
