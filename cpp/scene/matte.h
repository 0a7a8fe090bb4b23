// Lambert reflection by the same amount all over a surface: f = reflectance / pi. Most surfaces are
// like this, so walks ask for it before they call the plug-in; its values need no frame.
#pragma once

#include "math/warp.h"
#include "scene/scattering.h"

#include <optional>

namespace mlt {

/// Directions are given by their cosines against the shading normal.
struct Matte {
  Color front{0}, back{0};  ///< f on either side.
  bool two_sided = false;   ///< Without it the back side scatters nothing.

  Scattering scattering(double cos_l, double cos_c, Lobe lobe) const {
    if (lobe != Lobe::smooth || !(cos_l * cos_c > 0) || !(cos_l > 0 || two_sided)) return {};
    return {cos_l > 0 ? front : back, std::abs(cos_c) * inv_pi, std::abs(cos_l) * inv_pi};
  }

  /// A local direction, with the density that `scattering` tells.
  std::optional<Vec3> sample(double cos_from, const Vec2& u) const {
    if (!(cos_from > 0 || (two_sided && cos_from < 0))) return std::nullopt;
    Vec3 to = sample_cosine_hemisphere(u);
    if (!(to.z > 0)) return std::nullopt;
    if (cos_from < 0) to.z = -to.z;
    return to;
  }
};

}  // namespace mlt
