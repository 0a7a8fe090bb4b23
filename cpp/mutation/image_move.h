// The first step of a perturbation that starts at the lens: the image position moves by a small
// distance and, with a lens of finite aperture, half of the time the point on the lens too. The
// path follows.
#pragma once

#include "mutation/chain_perturbation.h"
#include "mutation/edge_visibility.h"
#include "path/walk.h"

namespace mlt {

/// A perturbation does not go from one light at infinity to another, nor to or from a surface.
inline bool same_light_at_infinity(const PathState& x, const PathState& y) {
  return x[0].at.infinite() == y[0].at.infinite() &&
         (!x[0].at.infinite() || x[0].emitter == y[0].emitter);
}

class ImageMove {
 public:
  ImageMove(const Scene& scene, const ChainPerturbation& chain)
      : camera_(&scene.camera()), chain_(chain) {}

  /// Places the camera end of y, and returns the ray from there; nullopt if it misses the image.
  std::optional<Ray> move(const PathState& x, PathState& y, Rng& rng) const {
    const int k = x.edges();
    y.path[k] = x[k];
    if (moves_on_lens() && rng.next() < 0.5) {
      const auto moved = camera_->move_on_lens(x[k].at, offset(lens_radius(), rng));
      if (!moved) return std::nullopt;
      y.path[k].at = *moved;
    }
    const Vec2 raster = x.raster + offset(chain_.image_radius(), rng);
    if (!camera_->raster().contains(raster)) return std::nullopt;
    return camera_ray(*camera_, y[k].at, raster);
  }

  /// Makes y from x by such a move, which is carried along `span`: Mutation::propose().
  std::optional<Edit> propose(const PathTarget& target, const PathState& x,
                              const ChainPerturbation::Span& span, PathState& y,
                              MutationContext& context) const {
    const int k = span.start, stop = span.stop;
    const Edit edit{stop, k, k - stop + 1};
    splice(x, edit, y);
    const auto ray = move(x, y, context.rng);
    if (!ray || !chain_.carry(x, span, *ray, y, context)) return std::nullopt;
    target.evaluate(stop, k, y);
    if (stop > 0) test_visibility(target.scene(), stop, y, context.rays);
    return edit;
  }

  /// Density of the point on the lens of y, times that of the direction in projected solid angle.
  double density(const PathState& x, const PathState& y) const {
    const double on_image = chain_.image_radius().planar_pdf(glm::length(y.raster - x.raster)) *
                            chain_.raster_per_direction(y);
    if (!moves_on_lens()) return on_image;
    const Vec3 from = x[x.edges()].at.p, to = y[y.edges()].at.p;
    return on_image * 0.5 * (from == to ? 1 : lens_radius().planar_pdf(length(to - from)));
  }

 private:
  static Vec2 offset(const ExponentialRadius& radius, Rng& rng) {
    const double r = radius.sample(rng.next()), phi = 2 * pi * rng.next();
    return r * Vec2(std::cos(phi), std::sin(phi));
  }

  bool moves_on_lens() const { return camera_->lens_radius() > 0; }
  /// Radii on the lens: a thousandth and a third of its own radius.
  ExponentialRadius lens_radius() const {
    return {1e-3 * camera_->lens_radius(), camera_->lens_radius() / 3};
  }

  const Camera* camera_;
  ChainPerturbation chain_;
};

}  // namespace mlt
