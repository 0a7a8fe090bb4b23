// A rough interface between two transparent media, such as frosted glass: microfacets that reflect
// and refract by Fresnel's equations (Walter et al. 2007, eqs. 20 and 21). Refraction is written
// for radiance that flows from wl to wc, so that f(wl, wc) / eta_c^2 is symmetric.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf.h"
#include "scene/bsdf/dielectric_interface.h"
#include "scene/bsdf/rough_surface.h"

namespace mlt {
namespace {

class RoughDielectric final : public Bsdf {
 public:
  explicit RoughDielectric(Params& params) : surface_(params), interface_(params) {
    if (interface_.eta() == 1) params.fail("needs an int_ior that differs from ext_ior");
  }

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    const Facet facet = facet_between(at, wl, wc, lobe);
    if (!facet.exists) return {};
    const Microfacet microfacet = surface_.at(at);
    const double D = microfacet.D(facet.h);
    const Masking light(microfacet, wl, facet.h), camera(microfacet, wc, facet.h);
    const double p = probability(facet);
    const Spectrum f = value(at, wl, wc, facet, D * light.fit * camera.fit);
    const double from_light = p * density(microfacet, wl, wc, facet, D, light.exact),
                 from_camera = p * density(microfacet, wc, wl, facet, D, camera.exact);
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
    const Facet facet = facet_between(at, from, to, lobe);
    const double p = interface_.reflection_probability(facet.F);
    return u_of(facet.reflects ? u_of_first(p, v.x) : u_of_second(p, v.x),
                surface_.at(at).invert(upwards(from), facet.h));
  }

  bool has_transmission() const override { return true; }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return on_side(interface_.eta(at), w);
  }
  double roughness(const SurfacePoint& at, const Vec3&, const Vec3&) const override {
    return surface_.alpha(at);
  }

  Spectrum albedo(const SurfacePoint& at) const override {
    const double F = fresnel_dielectric(1, interface_.eta()).reflectance;
    return interface_.albedo(at, F);
  }

 private:
  /// The microfacet that scatters from a to b.
  struct Facet {
    bool exists;
    bool reflects;
    Vec3 h;            ///< Its normal, above the surface.
    double eta;        ///< See DielectricInterface::eta.
    double cosine, F;  ///< Of light in the thinner medium; its Fresnel reflectance.
  };

  /// The facet that scatters from a to b; the same from b to a, bit for bit.
  Facet facet_between(const SurfacePoint& at, const Vec3& a, const Vec3& b, Lobe lobe) const {
    if (lobe != Lobe::smooth || a.z * b.z == 0) return {};
    const bool reflects = same_side(a, b);
    const double eta = interface_.eta(at);
    // Walter et al. 2007, eqs. 13 and 16, up to the sign and length.
    const Vec3 sum = reflects ? a + b : a.z > 0 ? a + eta * b : b + eta * a;
    if (sum.z == 0) return {};
    const Vec3 h = normalize(sum.z < 0 ? -sum : sum);
    const double cos_a = dot(a, h), cos_b = dot(b, h);
    if (cos_a * a.z <= 0 || cos_b * b.z <= 0) return {};
    // Refraction: in the thinner medium F is well conditioned up to grazing.
    const bool thin_is_above = eta > 1;
    const double cosine = reflects ? 0.5 * dot(sum, h) : (a.z > 0) == thin_is_above ? cos_a : cos_b;
    return {true, reflects, h, eta, cosine, fresnel_dielectric(cosine, eta).reflectance};
  }

  /// Value of the BSDF, given D G.
  Spectrum value(const SurfacePoint& at, const Vec3& wl, const Vec3& wc, const Facet& facet,
                 double DG) const {
    const double cosines = std::abs(wl.z * wc.z);
    if (facet.reflects) {
      const Spectrum F = interface_.at_wavelengths(at, facet.F, [&](double eta) {
        return fresnel_dielectric(facet.cosine, eta).reflectance;
      });
      return F * DG / (4 * cosines) * interface_.reflectance->eval(at);
    }
    const double l = dot(wl, facet.h), c = dot(wc, facet.h);
    // eq. 21, both eta divided by eta_c.
    const double jacobian = std::abs(l * c) / sqr(l * on_side(facet.eta, wl) + c);
    return (1 - facet.F) * DG * jacobian / cosines * interface_.transmittance->eval(at);
  }

  /// Density of `to` if this kind of facet (reflecting or refracting) is chosen.
  double density(const Microfacet& microfacet, const Vec3& from, const Vec3& to, const Facet& facet,
                 double D, double g1) const {
    if (facet.reflects) return reflection_pdf(microfacet, from, facet.h, D, g1);
    const double f = dot(from, facet.h), t = dot(to, facet.h);
    // eq. 17, both eta divided by the one on the side of `to`.
    return normal_pdf(microfacet, from, facet.h, D, g1) * std::abs(t) /
           sqr(f * on_side(facet.eta, from) + t);
  }

  double probability(const Facet& facet) const {
    const double p = interface_.reflection_probability(facet.F);
    return facet.reflects ? p : 1 - p;
  }

  static double on_side(double eta, const Vec3& w) { return w.z > 0 ? 1 / eta : eta; }

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
