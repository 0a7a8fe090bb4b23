// A third technique of path tracing, for light that a medium scatters. A walk comes to a vertex in
// a medium by its flight; this technique chooses, for a leg through a medium, a light for where the
// leg comes in, and the distance along the leg by the middle of the light (equiangular.h); then it
// samples a position on the light as next-event estimation does.
#pragma once

#include "path/direct_light.h"
#include "path/equiangular.h"
#include "path/stretch.h"

namespace mlt {

/// The first stretch of a leg in a medium, and the walk that comes to it.
class Approach {
 public:
  Approach() = default;
  /// For a leg that a walk begins with this throughput and this likelihood.
  Approach(const Stretch& stretch, const Spectrum& throughput, const Spectrum& likelihood)
      : stretch_(stretch) {
    if (!exists()) return;
    const Passage& before = stretch.before;
    const Spectrum flown = likelihood * before.flight;
    reached_ = mean(flown);
    likelihood_ = flown / reached_;
    throughput_ = throughput * before.transmittance / (before.probability * reached_);
  }

  bool exists() const { return stretch_.length > 0; }
  Vec3 direction() const { return stretch_.ray.d; }
  /// The throughput of the walk where the stretch begins.
  const Spectrum& throughput() const { return throughput_; }

  /// Chooses a light for the stretch.
  EmitterChoice choose(const Scene& scene, double u) const {
    return scene.choose_emitter_for(start(), u);
  }
  /// The distances for that light; none where the flight serves as well.
  Equiangular distances(const Emitter& light) const {
    constexpr double least_angle = 2;  // measured: docs/media.md
    if (light.infinite()) return {};
    const Equiangular near(start(), direction(), stretch_.length, light.middle(stretch_.ray.time));
    return near.angle() > least_angle ? near : Equiangular();
  }
  SurfacePoint point(double t) const { return Scene::medium_point(stretch_.ray, t); }
  /// The flight from where the stretch begins up to its point at a distance.
  Passage flight(const Scene& scene, double t) const {
    Passage passed;
    passed.likelihood = likelihood_;
    fly(scene.media()[stretch_.ray.medium], stretch_.ray, t, passed);
    return passed;
  }

  /// Tells the density of the flight with which the walk stops where the leg ends.
  void arrive(double flight_pdf) { stop_pdf_ = flight_pdf / reached_; }
  /// The density in solid angle with which the technique makes the direction w to x0 at that end,
  /// over the probability of coming there by flight.
  double direct_pdf(const Scene& scene, const Emitter& emitter, const SurfacePoint& x0,
                    const Vec3& w) const {
    if (!stretch_.stop) return 0;
    const double t = *stretch_.stop, pdf = distances(emitter).pdf(t);
    if (!(pdf > 0)) return 0;
    const double choice = scene.emitter_probability_for(emitter.index(), start());
    return mlt::direct_pdf(choice, emitter, point(t).p, x0, w) * (pdf / stop_pdf_);
  }

 private:
  Vec3 start() const { return stretch_.ray.o - stretch_.ray.before * direction(); }

  Stretch stretch_;
  double stop_pdf_ = 0;
  double reached_ = 1;  ///< The probability that the media before it let the walk pass.
  Spectrum likelihood_{1}, throughput_{0};
};

/// The approaches of a walk: of its leg, and of the one to its last vertex.
struct Approaches {
  Approach now, previous;
};

}  // namespace mlt
