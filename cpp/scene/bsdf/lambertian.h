// Lambert reflection: f = reflectance / pi. Most surfaces are like this, so it is found once, where
// a ray hits, and then replaces the plug-in; its values need no frame. The templates are for single
// paths, in double precision, and for waves, in single precision and without branches.
#pragma once

#include "math/warp.h"
#include "scene/bsdf/scattering.h"

#include <optional>

namespace mlt {

/// Whether a Lambertian surface scatters light in directions of this cosine; `both`: at its back,
/// too.
template <class F>
bool scatters(F cosine, bool both) {
  return (cosine > 0) | (both & (cosine < 0));
}

/// The density in solid angle of a scattered direction with this cosine.
template <class F>
F lambertian_pdf(F cosine) {
  return std::abs(cosine) * F(inv_pi);
}

/// Samples a local direction on the side of `cos_from`, with the density lambertian_pdf().
template <class F>
Vec3Of<F> sample_lambertian(F cos_from, const Vec2Of<F>& u) {
  Vec3Of<F> to = sample_cosine_hemisphere(u);
  to.z = std::copysign(to.z, cos_from);
  return to;
}

/// The scattering at a point. Directions are given by their cosines against the shading normal.
struct Lambertian {
  enum class Sides : uint8_t { unknown, front, both };

  Spectrum f{0};
  Sides sides = Sides::unknown;  ///< Sides that scatter light; unknown: use the plug-in.

  bool known() const { return sides != Sides::unknown; }
  bool scatters(double cosine) const { return mlt::scatters(cosine, sides == Sides::both); }

  Scattering scattering(double cos_l, double cos_c, Lobe lobe) const {
    if (lobe != Lobe::smooth || !(cos_l * cos_c > 0) || !scatters(cos_l)) return {};
    return {f, lambertian_pdf(cos_c), lambertian_pdf(cos_l)};
  }
  std::optional<Vec3> sample(double cos_from, const Vec2& u) const {
    if (!scatters(cos_from)) return std::nullopt;
    const Vec3 to = sample_lambertian(cos_from, u);
    return to.z != 0 ? std::optional(to) : std::nullopt;
  }
};

}  // namespace mlt
