// The common part of lens, caustic and multi-chain perturbation: an end of the path is moved a
// little, and the move is propagated from vertex to vertex (Veach & Guibas 1997, sec. 5.3.2; Veach
// 1997, sec. 11.3.3).
//
// The path is walked from `start` in steps of `step` (-1: from the camera, +1: from the light) up
// to `stop`; the vertices after `start` up to `stop` move. At a specular vertex the half vector is
// kept. At a diffuse vertex in between the direction is perturbed by a small angle (multi-chain) or
// kept (translucent). If `stop` is the light, the last ray has to hit a light.
//
// In media the kind of each vertex is kept, and the distance at which one in a medium follows the
// one before it: distances are not sampled, but are factors of one delta in both directions.
#pragma once

#include "base/params.h"
#include "mutation/exponential_radius.h"
#include "mutation/mutation.h"
#include "path/measure.h"

namespace mlt {

/// Radii between which the image position is perturbed: pixels, and a share of the image's
/// diagonal.
struct StepSizes {
  double smallest_pixels = 0.1, largest_share = 0.1;
};
/// The step sizes as parameters of a perturbation.
std::vector<Parameter> step_size_parameters();
StepSizes step_sizes(Params& params);

/// The angle between two unit vectors; exact for small angles too.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return 2 * std::atan2(length(a - b), length(a + b));
}

class ChainPerturbation {
 public:
  ChainPerturbation(const Scene& scene, const StepSizes& steps);

  struct Span {
    int start, stop, step;
    bool keeps = false;  ///< Whether directions at diffuse vertices are kept.
  };

  /// Moves vertices after span.start up to span.stop; the first of them is where `ray` hits. The
  /// terms of y are not evaluated.
  bool carry(const PathState& x, const Span& span, Ray ray, PathState& y,
             MutationContext& context) const;

  /// Product of the densities of the moved vertices of y; `first_coefficient` is the density of the
  /// first direction in projected solid angle at span.start.
  template <class Measure>
  double density(const Measure& in, const PathState& x, const PathState& y, const Span& span,
                 double first_coefficient) const {
    return walked_density(in, x, y, span, first_coefficient) *
           in.joint(span.step < 0 ? span.stop : span.stop + 1);
  }
  /// As density(), without the factor of the edge that joins `stop` to the rest.
  template <class Measure>
  double walked_density(const Measure& in, const PathState& x, const PathState& y, const Span& span,
                        double first_coefficient) const {
    const int s = span.step;
    double p = first_coefficient * y.terms.arrival(span.start, s).stops *
               in.step(span.start, span.start + s);
    for (int i = span.start + s; i != span.stop; i += s)
      p *= coefficient(x, y, i, span) * in.step(i, i + s);
    return p;
  }

  /// Radii of a step on the image, in pixels.
  const ExponentialRadius& image_radius() const { return image_radius_; }
  /// d(raster area) / d(projected solid angle) at the lens, for the direction of x.
  double raster_per_direction(const PathState& x) const;
  /// The angle that a pixel subtends at the lens of x.
  double pixel_angle(const PathState& x) const;
  /// Angles by which the direction at vertex i is perturbed so that `stop`, the end of the specular
  /// chain that begins there, moves by about the image radius.
  ExponentialRadius angle(const PathState& x, int i, int stop, int step) const;

  /// A direction at an exponentially distributed angle from `w`.
  static Vec3 perturb(const Vec3& w, const ExponentialRadius& angle, Rng& rng);

  /// The vertex that ends the specular chain from `start` on: the next diffuse one, or the path's
  /// end.
  static int chain_end(const PathState& x, int start, int step) {
    const int end = step < 0 ? 0 : x.edges();
    int i = start + step;
    while (i != end && x.specular(i)) i += step;
    return i;
  }

 private:
  std::optional<Vec3> carried_direction(const PathState& x, const PathState& y, int i,
                                        const Span& span, const Vec3& in,
                                        MutationContext& context) const;
  /// The distance from vertex i - step that vertex i of y keeps, if it is in a medium; else
  /// infinity.
  double kept_distance(const PathState& x, int i, int step, const Ray& ray) const;
  /// Density of the direction from y's vertex i, in projected solid angle, when x is perturbed, and
  /// of arriving at the next vertex.
  double coefficient(const PathState& x, const PathState& y, int i, const Span& span) const;

  const Scene* scene_;
  ExponentialRadius image_radius_;
};

}  // namespace mlt
