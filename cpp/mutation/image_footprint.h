// The footprint of a pixel in the directions that leave the light side of a specular chain: how
// such a direction has to turn so that the end of the chain moves by one pixel on the image. Light
// through glass is focused more in one direction than in another, so a move that is round on the
// image is an ellipse of directions (ray differentials: Igehy 1999; of chains: Jakob & Marschner
// 2012, sec. 4.2; anisotropic steps of chains: Li, Lehtinen, Ramamoorthi, Jakob & Durand 2015).
//
// It is a function of the path alone, so that the density of a step is known in both directions.
#pragma once

#include "base/rng.h"
#include "math/frame.h"
#include "mutation/exponential_radius.h"

#include <glm/mat2x2.hpp>

#include <optional>

namespace mlt {

class Scene;
struct PathState;

class ImageFootprint {
 public:
  /// The footprint in the directions from x_a towards the chain that ends at x_{k-1}; nullopt where
  /// it is not known, or far from round. `pixel_angle`: the angle of a pixel at the lens.
  static std::optional<ImageFootprint> of(const Scene& scene, const PathState& x, int a,
                                          double pixel_angle);

  /// The direction of x, turned by a step on the image of exponentially distributed length.
  Vec3 perturb(const ExponentialRadius& pixels, Rng& rng) const;
  /// Density of a direction, in solid angle.
  double pdf(const Vec3& w, const ExponentialRadius& pixels) const;

  ImageFootprint() = default;

 private:
  ImageFootprint(const Frame& around, const glm::dmat2& turn)
      : around_(around), turn_(turn), pixels_(glm::inverse(turn)) {}

  Frame around_{};       ///< The direction of x.
  glm::dmat2 turn_{};    ///< Pixels to the tangent of the turn.
  glm::dmat2 pixels_{};  ///< The inverse of turn_.
};

}  // namespace mlt
