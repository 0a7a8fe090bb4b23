// Light that one sample has found.
#pragma once

#include "math/color.h"
#include "math/vec.h"

#include <cmath>
#include <cstdint>

namespace mlt {

/// Light at one position of the image.
struct ImageLight {
  Vec2 raster{0};
  Color rgb{0};           ///< f / p, weighted among techniques.
  bool own_pixel = true;  ///< At the camera walk's own position, not by light tracing.
  uint64_t layers = 0;    ///< Layers that it belongs to, too: a LayerMask of light_layers.h.
};

/// A number for the pair of vertices that technique (s, t) of bidirectional path tracing joins, 0
/// where a walk from the camera or from a light makes the whole path.
inline int joint_number(int s, int t) { return s * t == 0 ? 0 : (s + t) * (s + t) + s; }

/// The light of one path, with what its weight beside chains depends on.
struct FoundLight : ImageLight {
  /// The factor that turns rgb into f / P, with P the density of all techniques; set by path
  /// tracing with the balance heuristic and by bidirectional path tracing.
  double over_density = 1;
  double certainty = 0;  ///< See certainty() of path_terms.h.
  int joint = 0;         ///< See joint_number().
  /// Set where there is a target T:
  double weight = 0;               ///< Contribution to b, the integral of the target: T / p.
  double target_over_density = 0;  ///< T / P (see ClampingWeights), or what stands for it.

  uint32_t emitter = 0;  ///< Index of its emitter, from waves that keep emitters apart.

  bool valid() const {
    return is_finite(rgb) && min_component(rgb) >= 0 && weight >= 0 && std::isfinite(weight) &&
           target_over_density >= 0;
  }
};

}  // namespace mlt
