// The base of materials that reflect light smoothly, on one side, by microfacets and what is below
// them. It needs a model, as in eight_points.h; its Point is the distribution of normals.
#pragma once

#include "scene/bsdf/eight_points.h"
#include "scene/bsdf/lobes.h"
#include "scene/bsdf/rough_surface.h"

namespace mlt {

template <class Model>
class MicrofacetReflector : public Bsdf {
 public:
  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const final {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    const auto terms = model().terms(microfacet(at), wl, wc);
    return {model().value(model().colors(at), terms), terms.pdf_from_light, terms.pdf_from_camera};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const final {
    if (from.z <= 0) return std::nullopt;
    const Vec3 to = model().direction(microfacet(at), from, u);
    return to.z > 0 ? std::optional<BsdfSample>({to, Lobe::smooth}) : std::nullopt;
  }

  void scatter(ScatteringLanes& x) const final { scatter_by_eight(model(), x); }

  static Float8 narrowest(const Ggx<Float8>& point) { return min(point.alpha_u, point.alpha_v); }

 protected:
  /// Serves lanes where eight points together are faster, and single precision is enough; to be
  /// called by the constructor of a model.
  void find_lanes(const Microfacet& typical) {
    serves_lanes_ = typical.type() == MicrofacetType::ggx && typical.sample_visible() &&
                    std::min(typical.alpha_u(), typical.alpha_v()) >= least_alpha_in_lanes;
  }

 private:
  const Model& model() const { return static_cast<const Model&>(*this); }
  Microfacet microfacet(const SurfacePoint& at) const {
    const SurfacePoint* one = &at;
    return model().template point<double>(&one);
  }
};

}  // namespace mlt
