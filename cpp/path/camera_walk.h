// A walk from the camera, and who watches it.
#pragma once

#include "path/approach.h"
#include "path/mis.h"
#include "path/refracted_light.h"

namespace mlt {

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
  /// The last vertex was connected to a position on a light; `radiance` is the result.
  void connect(const LightSample&, const Color& /*radiance*/) {}
  /// As above, but by a vertex in between, on the leg from the last one.
  void connect_between(const SurfacePoint&, const LightSample&, const Color& /*radiance*/) {}
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
  Approaches* approaches = nullptr;  ///< If it has the technique of approach.h.
  LegsInside* inside = nullptr;      ///< If it has the technique of refracted_light.h.

  MisExponent mis{Heuristic::power};  ///< For the two techniques.

  /// The light of a path as a film records it; its last vertex may disperse, too.
  Color seen(const Spectrum& light, bool disperses = false) const {
    return recorded(light, ray.wavelength, dispersed || disperses);
  }

  /// Begins a leg.
  void begin_leg(const Stretch& first) {
    if (!approaches) return;
    approaches->previous = approaches->now;
    approaches->now = Approach(first, throughput, likelihood);
  }
  /// Goes along the ray up to where it stops.
  void pass(const Passage& leg, const Arrival& arrival) {
    const double p = arrival.probability();
    if (approaches) approaches->now.arrive(arrival.flown());
    throughput = leg.is_blocked() ? Spectrum(0) : throughput * (leg.transmittance / p);
    scatter_pdf *= p;
    certainty *= p;
    likelihood = arrival.next_likelihood();
  }
};

}  // namespace mlt
