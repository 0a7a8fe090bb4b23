// The base of materials that reflect light smoothly, on one side. It needs a model, as in
// eight_points.h; of the points, least_alpha() tells the least roughness.
#pragma once

#include "scene/bsdf/eight_points.h"
#include "scene/bsdf/lobes.h"

namespace mlt {

template <class Model>
class SmoothReflector : public Bsdf {
 public:
  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const final {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    const auto terms = model().terms(point(at), wl, wc);
    return {model().value(model().colors(at), terms), terms.pdf_from_light, terms.pdf_from_camera};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const final {
    if (from.z <= 0) return std::nullopt;
    const Vec3 to = model().direction(point(at), from, u);
    return to.z > 0 ? std::optional<BsdfSample>({to, Lobe::smooth}) : std::nullopt;
  }

  void scatter(ScatteringLanes& x) const final { scatter_by_eight(model(), x); }

  template <class Point>
  static Float8 narrowest(const Point& point) {
    return point.least_alpha();
  }

 protected:
  /// What the model's textures say of one point.
  auto point(const SurfacePoint& at) const {
    const SurfacePoint* one = &at;
    return model().template point<double>(&one);
  }

 private:
  const Model& model() const { return static_cast<const Model&>(*this); }
};

}  // namespace mlt
