// A perfectly smooth interface between two transparent media, such as glass and air: light is
// reflected with the fraction F of Fresnel's equations, and refracted with the fraction 1 - F.
#include "base/registry.h"
#include "math/fresnel.h"
#include "scene/bsdf/bsdf.h"
#include "scene/bsdf/dielectric_interface.h"

namespace mlt {
namespace {

class Dielectric final : public Bsdf {
 public:
  explicit Dielectric(Params& params) : interface_(params) {}

  Scattering scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                        Lobe lobe) const override {
    if (!matches(wl, wc, lobe)) return {};
    const double F = fresnel(at, wl, wc);
    const double p = interface_.reflection_probability(F);
    if (lobe == Lobe::transmission)
      return interface_.refracted(at, (1 - F) * interface_.transmittance->eval(at), 1 - p, 1 - p);
    const Spectrum reflected = interface_.at_wavelengths(
        at, F, [&](double eta) { return fresnel_dielectric(wl.z, eta).reflectance; });
    return {reflected * interface_.reflectance->eval(at), p, p};
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, const Vec3& from,
                                   const Vec3& u) const override {
    if (from.z == 0) return std::nullopt;
    const Fresnel fresnel = fresnel_dielectric(from.z, interface_.eta(at));
    if (u.x < interface_.reflection_probability(fresnel.reflectance))
      return BsdfSample{reflect(from), Lobe::reflection};
    if (fresnel.cos_t == 0) return std::nullopt;
    return BsdfSample{refract(from, fresnel.cos_t, fresnel.eta_ti), Lobe::transmission};
  }

  std::optional<Vec3> invert(const SurfacePoint& at, const Vec3& from, const Vec3& to, Lobe lobe,
                             const Vec3& v) const override {
    if (!matches(from, to, lobe)) return std::nullopt;
    const double p = interface_.reflection_probability(fresnel(at, from, to));
    if (!((lobe == Lobe::reflection ? p : 1 - p) > 0)) return std::nullopt;
    return Vec3(lobe == Lobe::reflection ? u_of_first(p, v.x) : u_of_second(p, v.x), v.y, v.z);
  }

  bool has_smooth() const override { return false; }
  bool has_delta() const override { return true; }
  bool has_transmission() const override { return true; }
  double relative_eta(const SurfacePoint& at, const Vec3& w) const override {
    return w.z > 0 ? 1 / interface_.eta(at) : interface_.eta(at);
  }
  const SideIndex* index_inside() const override { return &interface_.inside(); }
  BsdfPtr immersed(const SideIndex& outside) const override {
    auto there = std::make_shared<Dielectric>(*this);
    there->interface_.immerse(outside);
    return there;
  }
  double roughness(const SurfacePoint&, const Vec3&, const Vec3&) const override { return 0; }

  Spectrum albedo(const SurfacePoint& at) const override {
    const double F = fresnel_dielectric(1, interface_.eta()).reflectance;
    return interface_.albedo(at, F);
  }

 private:
  static bool matches(const Vec3& a, const Vec3& b, Lobe lobe) {
    return lobe == Lobe::reflection     ? same_side(a, b)
           : lobe == Lobe::transmission ? a.z * b.z < 0
                                        : false;
  }

  /// F of a reflection or refraction from a to b. For a refraction it is computed from the
  /// direction in the thinner medium: F is the same from both, but well conditioned there.
  double fresnel(const SurfacePoint& at, const Vec3& a, const Vec3& b) const {
    const double eta = interface_.eta(at);
    const bool thin_is_above = eta >= 1;
    return fresnel_dielectric((a.z > 0) == thin_is_above ? a.z : b.z, eta).reflectance;
  }

  DielectricInterface interface_;
};

}  // namespace

Plugin bsdf_dielectric() {
  Plugin plugin = make_plugin<Dielectric>(
      "bsdf", "dielectric",
      "A smooth interface between two transparent media, such as glass and air.",
      concat({ior_parameters("bk7"), interface_factors()}));
  plugin.schema.reciprocal = false;
  return plugin;
}

}  // namespace mlt
