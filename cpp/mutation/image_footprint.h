// The footprint of a pixel in the directions that leave the light side of a specular chain: how
// such a direction has to turn so that the end of the chain moves by so much on the image. Light
// through glass is focused more in one direction than in another, so a move that is round on the
// image is an ellipse of directions (ray differentials: Igehy 1999; of chains: Jakob & Marschner
// 2012, sec. 4.2; anisotropic steps of chains: Li, Lehtinen, Ramamoorthi, Jakob & Durand 2015).
//
// The path alone says what it is, so that a step can be judged from either side.
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
  /// For directions that leave x_a towards the chain which ends at x_{k-1}; nullopt where it is not
  /// known, or far from round. `pixel_angle`: that a pixel is seen under from the lens.
  static std::optional<ImageFootprint> of(const Scene& scene, const PathState& x, int a,
                                          double pixel_angle);

  /// The direction of x turned by a move on the image at an exponentially distributed distance.
  Vec3 perturb(const ExponentialRadius& pixels, Rng& rng) const;
  /// Density of a direction, in solid angle.
  double pdf(const Vec3& w, const ExponentialRadius& pixels) const;

  ImageFootprint() = default;

 private:
  ImageFootprint(const Frame& around, const glm::dmat2& turn)
      : around_(around), turn_(turn), pixels_(glm::inverse(turn)) {}

  Frame around_{};       ///< The direction of x.
  glm::dmat2 turn_{};    ///< Tangent of the turn by pixels,
  glm::dmat2 pixels_{};  ///< and the other way round.
};

}  // namespace mlt
