// A rough metal: mirror-like microfacets with Fresnel's equations for a complex index of refraction
// (Cook & Torrance 1982; Walter et al. 2007, eq. 20):
//   f = F(wl . h) D(h) G(wl, wc, h) / (4 cos_l cos_c),   h = (wl + wc) / |wl + wc|.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf.h"
#include "scene/bsdf/ior_params.h"
#include "scene/bsdf/lobes.h"
#include "scene/bsdf/rough_surface.h"

namespace mlt {
namespace {

class RoughConductor final : public Bsdf {
 public:
  explicit RoughConductor(Params& params)
      : surface_(params),
        ior_(conductor_param(params)),
        reflectance_(texture_param(params, "specular_reflectance")) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (lobe != Lobe::smooth || !above(wl, wc)) return {};
    const Microfacet microfacet = surface_.at(at);
    const Vec3 h = normalize(wl + wc);
    const double D = microfacet.D(h);
    const Masking light(microfacet, wl, h), camera(microfacet, wc, h);
    return {value(at, wl, wc, h, D, light.fit * camera.fit),
            reflection_pdf(microfacet, wl, h, D, light.exact),
            reflection_pdf(microfacet, wc, h, D, camera.exact)};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z <= 0) return std::nullopt;
    const Vec3 h = surface_.at(at).sample(from, direction_part(u));
    const Vec3 to = reflect(from, h);
    if (dot(from, h) <= 0 || to.z <= 0) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (!(pdf(at, from, to, lobe) > 0)) return std::nullopt;
    return u_of(v.x, surface_.at(at).invert(from, normalize(from + to)));
  }

  double roughness(const SurfacePoint& at, const Vec3&, const Vec3&) const override {
    return surface_.alpha(at);
  }

  Spectrum albedo(const SurfacePoint& at) const override {
    return reflectance_->eval(at) * ior_.fresnel(1, at.wavelength);
  }

 private:
  Spectrum value(const SurfacePoint& at, const Vec3& wl, const Vec3& wc, const Vec3& h, double D,
                 double G) const {
    if (!(D * G > 0)) return Spectrum(0);
    const Spectrum F = ior_.fresnel(std::min(dot(wl, h), 1.0), at.wavelength);
    return reflectance_->eval(at) * F * (D * G / (4 * wl.z * wc.z));
  }

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
