// Lambert reflection at a point: f = reflectance / pi. Most surfaces are like this, so it is found
// once, where a ray hits, and then replaces the plug-in; its values need no frame.
#pragma once

#include "math/warp.h"
#include "scene/scattering.h"

#include <optional>

namespace mlt {

/// Directions are given by their cosines against the shading normal.
struct Lambertian {
  enum class Sides : uint8_t { unknown, front, both };

  Color f{0};
  Sides sides = Sides::unknown;  ///< Sides that scatter light; unknown: use the plug-in.

  bool known() const { return sides != Sides::unknown; }

  Scattering scattering(double cos_l, double cos_c, Lobe lobe) const {
    if (lobe != Lobe::smooth || !(cos_l * cos_c > 0) || !scatters(cos_l)) return {};
    return {f, std::abs(cos_c) * inv_pi, std::abs(cos_l) * inv_pi};
  }

  /// Samples a local direction, with the density of `scattering`.
  std::optional<Vec3> sample(double cos_from, const Vec2& u) const {
    if (!scatters(cos_from)) return std::nullopt;
    Vec3 to = sample_cosine_hemisphere(u);
    if (!(to.z > 0)) return std::nullopt;
    if (cos_from < 0) to.z = -to.z;
    return to;
  }

  /// Whether light is scattered in directions of this cosine.
  bool scatters(double cos) const { return cos > 0 || (sides == Sides::both && cos < 0); }
};

}  // namespace mlt
