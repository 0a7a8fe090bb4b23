// A rough metal: mirror-like microfacets with Fresnel's equations for a complex index of refraction
// (Cook & Torrance 1982; Walter et al. 2007, eq. 20):
//   f = F(wl . h) D(h) G(wl, wc, h) / (4 cos_l cos_c),   h = (wl + wc) / |wl + wc|.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/rough_surface.h"
#include "scene/bsdf/smooth_reflector.h"

namespace mlt {
namespace {

class RoughConductor final : public SmoothReflector<RoughConductor> {
 public:
  explicit RoughConductor(Params& params)
      : surface_(params),
        ior_(conductor_param(params)),
        reflectance_(texture_param(params, "specular_reflectance")) {
    supports_lanes_ = fits_lanes(surface_.typical());
  }

  template <class F>
  auto point(const SurfacePoint* const* at) const {
    if constexpr (is_number<F>)
      return surface_.at(**at);
    else
      return surface_.ggx(at);
  }

  template <class F>
  struct Terms {
    F factor, cos_h, pdf_from_light, pdf_from_camera;
    Terms<double> of_lane(int i) const { return {factor[i], cos_h[i], 0, 0}; }
  };
  template <class Normals, class F>
  Terms<F> terms(const Normals& microfacet, const Vec3Of<F>& wl, const Vec3Of<F>& wc) const {
    const MicrofacetReflection mirror(microfacet, wl, wc);
    return {mirror.DG / (4 * wl.z * wc.z), min(dot(wl, mirror.h), F(1)), mirror.pdf_from_light,
            mirror.pdf_from_camera};
  }

  template <class Normals, class F>
  Vec3Of<F> direction(const Normals& microfacet, const Vec3Of<F>& from, const Vec3Of<F>& u) const {
    return mirrored(microfacet, from, Vec2Of<F>(u.y, u.z));
  }

  struct Colors {
    Spectrum specular;
    double wavelength;
  };
  Colors colors(const SurfacePoint& at) const { return {reflectance_->eval(at), at.wavelength}; }
  Spectrum value(const Colors& colors, const Terms<double>& terms) const {
    if (!(terms.factor > 0)) return Spectrum(0);
    return colors.specular * ior_.fresnel(terms.cos_h, colors.wavelength) * terms.factor;
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (!(pdf(at, from, to, lobe) > 0)) return std::nullopt;
    return u_of(v.x, surface_.at(at).invert(from, normalize(from + to)));
  }

  double roughness(const SurfacePoint& at, const Vec3&, const Vec3&) const override {
    return surface_.alpha(at);
  }
  double least_roughness() const override { return surface_.least_alpha(); }

  Spectrum albedo(const SurfacePoint& at) const override {
    return reflectance_->eval(at) * ior_.fresnel(1, at.wavelength);
  }

 private:
  RoughSurface surface_;
  ConductorIor ior_;
  TexturePtr reflectance_;
};

}  // namespace

Plugin bsdf_roughconductor() {
  return make_plugin<RoughConductor>("bsdf", "roughconductor", "A rough metal.",
                                     concat({rough_surface_parameters(), conductor_parameters()}));
}

}  // namespace mlt
