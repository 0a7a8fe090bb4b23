// A rough interface between two transparent media, such as frosted glass: microfacets that reflect
// and refract by Fresnel's equations (Walter et al. 2007, eqs. 20 and 21).
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/dielectric_interface.h"
#include "scene/bsdf/glass_facet.h"

namespace mlt {
namespace {

class RoughDielectric final : public Bsdf {
 public:
  explicit RoughDielectric(Params& params) : surface_(params), interface_(params) {
    if (interface_.eta() == 1) params.fail("needs an int_ior that differs from ext_ior");
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    const GlassFacet facet = facet_between(at, wl, wc, lobe);
    if (!facet.exists) return {};
    const Microfacet microfacet = surface_.at(at);
    const double D = microfacet.D(facet.h);
    const Masking light(microfacet, wl, facet.h), camera(microfacet, wc, facet.h);
    const double p = probability(facet);
    const Spectrum f = value(at, wl, wc, facet, D * light.fit * camera.fit);
    const double from_light = p * facet_pdf(microfacet, wl, wc, facet, D, light.exact),
                 from_camera = p * facet_pdf(microfacet, wc, wl, facet, D, camera.exact);
    if (facet.reflects) return {f, from_light, from_camera};
    return interface_.refracted(at, f, from_light, from_camera);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z == 0) return std::nullopt;
    const Vec3 h = surface_.at(at).sample(upwards(from), direction_part(u));
    const double cos_h = dot(from, h);
    if (cos_h * from.z <= 0) return std::nullopt;
    const Fresnel fresnel = fresnel_dielectric(cos_h, interface_.eta(at));
    const bool reflects = u.x < interface_.reflection_probability(fresnel.reflectance);
    if (!reflects && fresnel.cos_t == 0) return std::nullopt;
    const Vec3 to = reflects ? reflect(from, h) : refract(from, h, fresnel.cos_t, fresnel.eta_ti);
    if (to.z == 0 || same_side(from, to) != reflects) return std::nullopt;
    return BsdfSample{to, Lobe::smooth};
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (!(pdf(at, from, to, lobe) > 0)) return std::nullopt;
    const GlassFacet facet = facet_between(at, from, to, lobe);
    const double p = interface_.reflection_probability(facet.F);
    return u_of(facet.reflects ? u_of_first(p, v.x) : u_of_second(p, v.x),
                surface_.at(at).invert(upwards(from), facet.h));
  }

  bool has_transmission() const override { return true; }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return eta_on_side(interface_.eta(at), w);
  }
  const SideIndex* index_inside() const override { return &interface_.inside(); }
  BsdfPtr immersed(const SideIndex& outside) const override {
    auto there = std::make_shared<RoughDielectric>(*this);
    there->interface_.immerse(outside);
    if (there->interface_.eta() == 1) there->interface_.immerse(barely_denser(outside));
    return there;
  }
  double roughness(const SurfacePoint& at, const Vec3&, const Vec3&) const override {
    return surface_.alpha(at);
  }

  Spectrum albedo(const SurfacePoint& at) const override {
    const double F = fresnel_dielectric(1, interface_.eta()).reflectance;
    return interface_.albedo(at, F);
  }

 private:
  GlassFacet facet_between(const SurfacePoint& at, const Vec3& a, const Vec3& b, Lobe lobe) const {
    return lobe == Lobe::smooth ? glass_facet(a, b, interface_.eta(at)) : GlassFacet{};
  }

  /// Value of the BSDF, given D G.
  Spectrum value(const SurfacePoint& at, const Vec3& wl, const Vec3& wc, const GlassFacet& facet,
                 double DG) const {
    const double cosines = std::abs(wl.z * wc.z);
    if (facet.reflects) {
      const Spectrum F = interface_.at_wavelengths(at, facet.F, [&](double eta) {
        return fresnel_dielectric(facet.cosine, eta).reflectance;
      });
      return F * DG / (4 * cosines) * interface_.reflectance->eval(at);
    }
    return (1 - facet.F) * DG * refraction_jacobian(facet, wl, wc) / cosines *
           interface_.transmittance->eval(at);
  }

  double probability(const GlassFacet& facet) const {
    const double p = interface_.reflection_probability(facet.F);
    return facet.reflects ? p : 1 - p;
  }

  RoughSurface surface_;
  DielectricInterface interface_;
};

}  // namespace

Plugin bsdf_roughdielectric() {
  Plugin plugin = make_plugin<RoughDielectric>(
      "bsdf", "roughdielectric",
      "A rough interface between two transparent media, such as frosted glass.",
      concat({ior_parameters("bk7"), rough_surface_parameters(), interface_factors()}));
  plugin.schema.reciprocal = false;
  return plugin;
}

}  // namespace mlt
