// The base of materials that reflect light smoothly, on one side, by microfacets and what is below
// them. A model has, over numbers F that are double or, with Ggx for its normals, Float8:
//
//   Microfacet microfacet(at)                  the distribution of normals
//   bool       is_constant()                   whether it is the same everywhere
//   Terms<F>   terms(microfacet, wl, wc)       factors of its colours, and densities
//   Vec3Of<F>  direction(microfacet, from, u)  a sample; not above the surface: there is none
//   Colors     colors(at)                      what its textures say of the point
//   Spectrum   value(colors, terms)            the BSDF
#pragma once

#include "scene/bsdf.h"
#include "scene/bsdf/lobes.h"
#include "scene/bsdf/rough_surface.h"

namespace mlt {

template <class Model>
class MicrofacetReflector : public Bsdf {
 public:
  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const final {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    const auto terms = model().terms(model().microfacet(at), wl, wc);
    return {model().value(model().colors(at), terms), terms.pdf_from_light, terms.pdf_from_camera};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const final {
    if (from.z <= 0) return std::nullopt;
    const Vec3 to = model().direction(model().microfacet(at), from, u);
    return to.z > 0 ? std::optional<BsdfSample>({to, Lobe::smooth}) : std::nullopt;
  }

  void scatter(ScatteringLanes& x) const final {
    x.fill_up();
    for (int i = 0; i < x.count; i += 8) scatter_eight(x, i);
  }

 protected:
  /// Serves lanes where eight points together are faster, and single precision is enough; to be
  /// called by the constructor of a model.
  void find_lanes() {
    if (!model().is_constant()) return;
    const Microfacet microfacet = model().microfacet({});
    serves_lanes_ = microfacet.type() == MicrofacetType::ggx && microfacet.sample_visible() &&
                    std::min(microfacet.alpha_u(), microfacet.alpha_v()) >= 0.02;
  }

 private:
  const Model& model() const { return static_cast<const Model&>(*this); }

  void scatter_eight(ScatteringLanes& x, int first) const {
    const Ggx<double> ggx = model().microfacet(*x.at[first]).ggx();
    const Ggx<Float8> microfacet{number<Float8>(ggx.alpha_u), number<Float8>(ggx.alpha_v)};
    const Vec3Of<Float8> wc = x.wc.eight(first), wl = x.wl.eight(first);
    const Vec3Of<Float8> u{x.u_lobe.eight(first), x.u_x.eight(first), x.u_y.eight(first)};
    const Vec3Of<Float8> sampled = model().direction(microfacet, wc, u);
    const auto is_lit = (wl.z > 0) & (wc.z > 0), goes_on = (sampled.z > 0) & (wc.z > 0);
    const Vec3Of<Float8> up(Float8(0), Float8(0), Float8(1));
    const auto light = model().terms(microfacet, select(is_lit, wl, up), select(is_lit, wc, up));
    const Vec3Of<Float8> to = select(goes_on, sampled, up);
    const auto next = model().terms(microfacet, to, select(goes_on, wc, up));
    x.pdf_light.set_eight(first, select(is_lit, light.pdf_from_camera, Float8(0)));
    x.pdf.set_eight(first, select(goes_on, next.pdf_from_camera, Float8(0)));
    x.to.set_eight(first, to);
    for (int lane = 0, i = first; lane < 8 && i < x.count; ++lane, ++i) {
      const auto colors = model().colors(*x.at[i]);
      x.f_light[i] = is_lit[lane] ? model().value(colors, light.of_lane(lane)) : Spectrum(0);
      x.f[i] = goes_on[lane] ? model().value(colors, next.of_lane(lane)) : Spectrum(0);
    }
  }
};

}  // namespace mlt
